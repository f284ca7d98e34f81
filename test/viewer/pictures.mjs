// SPDX-License-Identifier: MIT
// pictures.mjs ADDRESS FOLDER PAGE: pictures of the served rescue for docs/guide/view.md, and of a page with two runs.
import { chromium } from "playwright-core";

const [address, folder, both] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.goto(address);
await page.waitForFunction(() => window.rovernet?.ready);
await page.evaluate(() => window.rovernet.seek(10008000000));

/** Waits until what was asked for is drawn. */
async function settled() {
    await page.waitForLoadState("networkidle");
    await page.waitForTimeout(800);
}

await page.evaluate(() => window.rovernet.select({ robots: [0, 4] }));
await page.getByRole("tab", { name: "Pair" }).click();
await page.getByText("budget at this time").click();
await settled();
await page.screenshot({ path: `${folder}/view-pair.png` });

await page.evaluate(() => window.rovernet.select({ robots: [4] }));
await page.getByRole("tab", { name: "Robot" }).click();
await page.getByText("coverage", { exact: true }).click();
await settled();
await page.screenshot({ path: `${folder}/view-coverage.png` });
await page.getByText("coverage", { exact: true }).click();

await page.evaluate(() => window.rovernet.seek(13011000000));
await page.evaluate(() => window.rovernet.select({ robots: [], message: 1 }));
await page.getByRole("tab", { name: "Message" }).click();
await settled();
await page.screenshot({ path: `${folder}/view-message.png` });

await page.goto(`file://${both}`);
await page.waitForFunction(() => window.rovernet?.ready);
await page.locator("#compare-panel li button").first().click();
await settled();
await page.screenshot({ path: `${folder}/view-compare.png` });
await browser.close();

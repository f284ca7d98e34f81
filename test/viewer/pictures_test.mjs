// SPDX-License-Identifier: MIT
// Three pictures of the map beside stored ones. Rasterisers differ by version, so some pixels may.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { drawn, folder, with_page } from "./page.mjs";

const most_different = 0.01, same = 16;  // share of pixels; of 255, in each channel
const { ACCEPT: accept } = process.env;

/** Makes the map 640 x 400 large: what stands around it has its own size, and more lines once frames were met. */
async function resize(page) {
    for (let i = 0, fitting = 0; i < 20 && fitting < 2; i++) {
        const { width, height } = await page.evaluate(() => ({ width: 640 - document.getElementById("map").clientWidth, height: 400 - document.getElementById("map").clientHeight }));
        fitting = width === 0 && height === 0 ? fitting + 1 : 0;
        const now = page.viewportSize();
        if (!fitting) await page.setViewportSize({ width: now.width + width, height: now.height + height });
        await drawn(page);
        await drawn(page);
    }
}

/** Share of pixels that differ between two pictures, and number of colours of the first. */
function compared(page, pictures) {
    return page.evaluate(async ({ all, tolerance }) => {
        const [a, b] = await Promise.all(all.map(async url => {
            const image = new Image();
            image.src = url;
            await image.decode();
            const canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [image.width, image.height];
            const c = canvas.getContext("2d");
            c.drawImage(image, 0, 0);
            return c.getImageData(0, 0, image.width, image.height);
        }));
        if (a.width !== b.width || a.height !== b.height) return { share: 1, colors: 0, size: `${a.width} x ${a.height}` };
        let different = 0;
        for (let i = 0; i < a.data.length; i += 4) {
            different += [0, 1, 2].some(k => Math.abs(a.data[i + k] - b.data[i + k]) > tolerance) ? 1 : 0;
        }
        return { share: different / (a.width * a.height), colors: new Set(new Uint32Array(a.data.buffer)).size, size: `${a.width} x ${a.height}` };
    }, { all: pictures, tolerance: same });
}

for (const [name, state] of [
    ["rescue", { t: 10.008e9, robots: [0], trails: true }],
    ["storeys", { t: 13.1e9, storey: 1, trails: true }],
    ["csma", { t: 5.0211e9, robots: [3], trails: false }]
]) {
    test(`view page: the map of ${name} equals a stored picture, in at least 99 % of the pixels`, () => with_page(name, { context: { colorScheme: "light" } }, async page => {
        await page.evaluate(chosen => window.rovernet.select(chosen), state);
        await drawn(page);
        await resize(page);
        const url = await page.evaluate(() => document.getElementById("map").toDataURL()), stored = path.join(folder, "pictures", `${name}.png`);
        if (accept) fs.writeFileSync(path.join(accept, `${name}.png`), Buffer.from(url.split(",")[1], "base64"));
        const { share, colors, size } = await compared(page, [url, accept ? url : `data:image/png;base64,${fs.readFileSync(stored, "base64")}`]);
        assert.equal(size, "640 x 400");
        assert.ok(colors >= 5, `${colors} colours`);
        assert.ok(share <= most_different, `${(100 * share).toFixed(2)} % of the pixels differ; if they should: test/viewer/check COMMAND --accept`);
    }));
}

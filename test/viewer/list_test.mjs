// SPDX-License-Identifier: MIT
// The list of events, as one uses it by the mouse.
import assert from "node:assert/strict";
import test from "node:test";
import { drawn, with_page } from "./page.mjs";

test("view page, list of events: a slow double click selects the message in the row of the first click, even if the rows have moved", () => with_page("rescue", {}, async page => {
    const { x, y } = await page.locator("#events .row").nth(9).boundingBox();
    const wanted = /message \d+/.exec(await page.locator("#events .row").nth(9).textContent())[0];
    await page.mouse.move(x + 60, y + 10);
    for (const clickCount of [1, 2]) {
        await page.mouse.down({ clickCount });
        await page.mouse.up({ clickCount });
        await drawn(page);
    }
    assert.equal(await page.textContent("#message-panel h2"), wanted);
    assert.notEqual(/message \d+/.exec(await page.locator("#events .row").nth(9).textContent())[0], wanted);
}));

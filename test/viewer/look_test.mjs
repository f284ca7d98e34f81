// SPDX-License-Identifier: MIT
// How the page looks: nothing is cut off, texts do not cover each other, colours stand out from the paper.
import assert from "node:assert/strict";
import path from "node:path";
import test from "node:test";
import { drawn, folder, with_page, with_served, with_server } from "./page.mjs";

test("view page, small window: at 1024 x 640 the page needs no scrolling, and its map is at least 250 pixels high", () => with_page("csma", { context: { viewport: { width: 1024, height: 640 } } }, async page => {
    const { wide, high, map } = await page.evaluate(() => ({
        wide: document.documentElement.scrollWidth, high: document.documentElement.scrollHeight, map: document.getElementById("map").clientHeight
    }));
    assert.ok(wide <= 1024 && high <= 640 && map >= 250, `${wide} x ${high}, map ${map}`);
}));

for (const [scheme, least] of [["light", 3], ["dark", 4.5]]) {
    test(`view page: colours of robots, outcomes and doors have enough contrast with the ${scheme} background`, () => with_page("csma", { context: { colorScheme: scheme } }, async page => {
        const contrasts = await page.evaluate(() => {
            const luminance = color => {
                const [r, g, b] = rovernet.parts.theme.channels(color).map(v => v / 255).map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
                return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
            };
            const paper = luminance(rovernet.parts.theme.colors().paper), { outcomes, category, door, stairs } = rovernet.parts.signs.look.colors;
            return [...category.map((_, i) => rovernet.parts.theme.category(i)), ...[...outcomes, door, stairs].map(rovernet.parts.theme.readable)].map(color => Math.max(luminance(color) / paper, paper / luminance(color)));
        });
        assert.ok(contrasts.length > 20);
        assert.ok(Math.min(...contrasts) >= least, contrasts.map(c => c.toFixed(2)).join(" "));
    }));
}

/** Boxes of the texts that the map writes at another time. */
function written(page, t) {
    return page.evaluate(async other => {
        const found = [], { prototype } = CanvasRenderingContext2D, write = prototype.fillText;
        prototype.fillText = function (text, x, y) {
            if (this.canvas.id === "map") found.push({ text, left: x, right: x + this.measureText(text).width, y });
            write.call(this, text, x, y);
        };
        window.rovernet.select({ t: other });
        await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
        prototype.fillText = write;
        return found;
    }, t);
}

/** No text lies on another one. */
function check_apart(texts) {
    for (const [i, a] of texts.entries()) {
        for (const b of texts.slice(0, i)) assert.ok(a.left >= b.right || b.left >= a.right || Math.abs(a.y - b.y) >= 10, `${a.text} covers ${b.text}`);
    }
}

test("view page: names of robots do not cover each other", () => with_page("csma", { hash: "#t=5", context: { viewport: { width: 1024, height: 640 } } }, async page => {
    const texts = await written(page, 5.000001e9);
    assert.ok(texts.length > 5);
    check_apart(texts);
}));

test("view page: names of robots and losses of walls do not cover each other on a small map", () => with_server(path.join(folder, "rescue"), address => with_served(address, {}, async page => {
    const bounds = await page.evaluate(() => rovernet.parts.sides.own.all[0].run.head.map.bounds), [left, bottom, right, top] = bounds;
    await page.evaluate(state => window.rovernet.select(state), { t: 10e9, robots: [0, 4], panel: "pair", view: { x: (left + right) / 2, y: (bottom + top) / 2, scale: 6 } });
    await drawn(page);
    await page.getByText("budget at this time").click();
    await page.waitForFunction(() => document.querySelectorAll("#pair-answer h3").length === 2);
    const texts = await written(page, 10.000001e9);
    assert.ok(texts.filter(({ text }) => text.endsWith(" dB")).length > 1 && texts.some(({ text }) => text === "E"), JSON.stringify(texts));
    check_apart(texts);
})));

test("view page: a swarm at rest is drawn completely again after a zoom to one of its robots", () => with_page("swarm", {}, async page => {
    /** Picture of the map as it is drawn first in that view: what is drawn later may mend it. */
    const map = view => page.evaluate(async state => {
        rovernet.select({ t: 0.31e9, ...state });
        await new Promise(done => requestAnimationFrame(done));
        return document.getElementById("map").toDataURL();
    }, { view });
    const robot = await page.evaluate(() => rovernet.position(5)), all = { x: 50, y: 30, scale: 6 }, one = { x: robot.x, y: robot.y, scale: 1000 };
    await map(all);
    await drawn(page);
    const before = await map(all);
    assert.notEqual(await map(one), before);
    await drawn(page);
    assert.equal(await map(all), before);
}));

// SPDX-License-Identifier: MIT
// Written pages of other inputs, with a limit, damaged, without WebGL; the page itself, made twice.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { made_page, minify } from "./made_page.mjs";
import { colors, drawn, folder, launched, most_apart, printed, scenario, told, with_page } from "./page.mjs";
import { html, sections, view_file } from "./run_file.mjs";

for (const [name, robots] of [["stage", 3], ["movement", 50], ["doors", 2]]) {
    test(`view page: the page of ${name} loads no other file, and shows robots at the positions that rovernet where prints`, () => with_page(name, {}, async page => {
        const { head } = sections(view_file(name));
        assert.equal(head.robots.length, robots);
        assert.ok(await colors(page) >= 5);
        const most = await most_apart(page, name, head.duration_ns, 50);
        assert.ok(most < 1e-3, `${most} m apart`);
    }));
}

test("view page: the page of an ns-2 trace has its robots and messages, and a notice that map and radio are missing", () => with_page("ns2", {}, async page => {
    const { head } = sections(view_file("ns2")), truth = told("trace", "stats", scenario("ns2"), "--json");
    assert.equal(head.counts.messages, truth.messages);
    assert.equal(head.counts.flights, truth.transmissions);
    assert.equal(head.counts.receptions, truth.receptions);
    assert.equal(head.counts.outcomes.reduce((sum, n, outcome) => sum + (outcome % 2 ? n : 0), 0), truth.deliveries);
    assert.match(await page.textContent("#notice"), /ns-2 trace contains no map and no radio/);
    // Its positions have two digits.
    const most = await most_apart(page, "rescue", 80e9, 50);
    assert.ok(most < 0.03, `${most} m apart`);
}));

test("view page: on each storey a door is drawn as closed only while it is closed", () => with_page("doors", {}, async page => {
    /** Colours of a line across the place of a door. */
    const across = async (storey, t) => {
        await page.evaluate(state => window.rovernet.select({ ...state, trails: false, view: { x: 11.7, y: 5.05, scale: 200 } }), { storey, t });
        await drawn(page);
        return page.evaluate(() => {
            const canvas = document.getElementById("map"), { width, height } = canvas, copy = document.createElement("canvas");
            copy.width = 1;
            copy.height = 16;
            const c = copy.getContext("2d", { willReadFrequently: true });
            c.drawImage(canvas, width / 2, height / 2 - 8, 1, 16, 0, 0, 1, 16);
            return [...c.getImageData(0, 0, 1, 16).data].join(" ");
        });
    };
    for (const [storey, times] of [[0, [1e9, 20e9, 6e9]], [1, [1e9, 9e9, 12e9]]]) {
        const [open, again, closed] = [await across(storey, times[0]), await across(storey, times[1]), await across(storey, times[2])];
        assert.equal(open, again);
        assert.notEqual(open, closed);
    }
}));

test("view page: a page made with --limit is within the limit, states how many frames it omits, and keeps all movements and messages", async () => {
    const whole = sections(view_file("csma")), size = html("csma").length, data = Math.ceil(view_file("csma").length / 3) * 4;
    const limit = Math.floor((size - data / 4) / 1e3), file = path.join(folder, "limited.html");
    assert.match(printed("view", path.join(folder, "csma"), "-o", file, "--limit", `${limit} kB`), /limited.html/);
    assert.ok(fs.statSync(file).size <= limit * 1e3);
    const { head, unpacked } = sections(view_file("limited"));
    const frames = head.blocks.reduce((sum, block) => sum + block.flights, 0);
    assert.ok(frames > 0 && frames < whole.head.counts.flights);
    assert.ok(head.thinned.includes(`${whole.head.counts.flights - frames} of ${whole.head.counts.flights} frames are left out.`));
    for (const [name, bytes] of whole.unpacked) if (/^(legs|messages|walls)/.test(name) && name !== "messages.block") assert.ok(bytes.equals(unpacked.get(name)), name);
    await with_page("limited", {}, async page => {
        for (const sentence of head.thinned) assert.ok((await page.locator("#notice").textContent()).includes(sentence));
        assert.ok(await page.locator("#notice").isVisible());
        await page.evaluate(t => window.rovernet.seek(t), head.duration_ns);
        await drawn(page);
    });
});

test("page build: two builds of the page without node and npm are equal, with the style and script of the page that rovernet view makes", () => {
    const [page, again] = ["first", "second"].map(name => made_page(name, minify));
    assert.equal(page, again);
    assert.ok(page.length > 50_000);
    for (const [element] of html("rescue").matchAll(/<(style|script)>[^]*?<\/\1>/g)) assert.ok(page.includes(element), `${element.slice(0, 60)} is another`);
});

test("view page: without WebGL the page still draws its map, with all robots at the right positions", async () => {
    const browser = await launched("--disable-3d-apis");
    try {
        await with_page("rescue", { browser }, async page => {
            assert.equal(await page.evaluate(() => document.createElement("canvas").getContext("webgl2")), null);
            assert.ok(await colors(page) >= 5);
            const most = await most_apart(page, "rescue", sections(view_file("rescue")).head.duration_ns, 50);
            assert.ok(most < 1e-3, `${most} m apart`);
        });
    } finally {
        await browser.close();
    }
});

for (const [what, damage, error] of [
    ["incomplete base64", data => data.slice(0, data.length / 2 & ~3), /cut off/],
    ["invalid base64", data => `!${data.slice(1)}`, /no base64/],
    ["no run", () => "", /There is no run/],
    ["an unknown format", data => Buffer.from(Buffer.from(data, "base64").toString("latin1").replace("\"rvw\":1", "\"rvw\":7"), "latin1").toString("base64"), /format 7/],
    ["a damaged column", data => {
        const bytes = Buffer.from(data, "base64"), { head } = sections(bytes), legs = head.sections.find(s => s.name === "legs.x");
        bytes.fill(255, 8 + bytes.readUInt32LE(4) + legs.offset, 8 + bytes.readUInt32LE(4) + legs.offset + legs.bytes);
        return bytes.toString("base64");
    }, /legs.x/]
]) {
    test(`view page: a page with ${what} shows a sentence that names the fault`, async () => {
        const file = path.join(folder, "broken.html");
        fs.writeFileSync(file, html("storeys").replace(/(id="run"[^>]*>)([^<]*)/, (_, begin, data) => begin + damage(data)));
        await with_page(file, { error }, async page => {
            const text = await page.locator("#notice").textContent();
            assert.match(text, error);
            assert.match(text, /^[A-Z].*[.]$/);
            assert.ok(await page.locator("#notice").isVisible());
        });
    });
}

// SPDX-License-Identifier: MIT
// Two runs in a page: their counts are those of the command line, and each is where its controls say.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { drawn, folder, printed, scenario, told, trace, with_command, with_page, with_served } from "./page.mjs";
import { sections, view_file } from "./run_file.mjs";

const radio = "propagation.model=friis";

/** State of the page. */
function state(page) { return page.evaluate(() => structuredClone(window.rovernet.state)); }

/** Pixels of a part of the map, its shares of the width, as numbers: read from a copy, which leaves the map as it is. */
function pixels(page, from, to, count) {
    return page.evaluate(([low, high, counted]) => {
        const map = document.getElementById("map"), copy = document.createElement("canvas"), left = Math.ceil(low * map.width);
        [copy.width, copy.height] = [Math.floor(high * map.width) - left, map.height];
        const c = copy.getContext("2d", { willReadFrequently: true });
        c.drawImage(map, -left, 0);
        const all = new Uint32Array(c.getImageData(0, 0, copy.width, copy.height).data.buffer);
        return counted === undefined ? new Set(all).size : all.reduce((n, pixel) => n + (pixel === counted ? 1 : 0), 0);
    }, [from, to, count]);
}

/** Number of colours of a part of the map. */
function colors(page, from, to) { return pixels(page, from, to); }

/** Number of pixels of a colour, #rrggbb, in a part of the map. */
function of_color(page, from, to, color) {
    const [r, g, b] = [1, 3, 5].map(i => parseInt(color.slice(i, i + 2), 16));
    return pixels(page, from, to, (0xff000000 | b << 16 | g << 8 | r) >>> 0);
}

test("view page, two runs: the numbers of gained and lost deliveries equal those of replay --with", () => with_page("both", {}, async page => {
    const [{ gained, lost }] = told("replay", trace("rescue"), "--with", radio, "--json").radios;
    const text = await page.locator("#compare-panel").innerText();
    assert.equal(gained, 53);
    assert.ok(text.includes(`${gained} in run B only`) && text.includes(`${lost} in run A only`) && text.includes("31 in both"), text);
    assert.equal(await page.locator("#compare-panel li").count(), gained + lost);
    assert.match(text, /It differs in: robots reachable/);
    assert.deepEqual(await page.locator("#labels span").allInnerTexts(), ["A: rescue", `B: rescue, with ${radio}`]);
}));

test("view page, two runs: two equal runs have no list of differences", async () => {
    const file = path.join(folder, "equal.html");
    printed("view", path.join(folder, "rescue"), path.join(folder, "rescue"), "-o", file);
    await with_page("equal", {}, async page => assert.deepEqual(await page.locator("#compare-panel h3").allInnerTexts(), ["First record that differs", "Runs"]));
});

test("view page, two runs: buttons and keys show both maps side by side, or one of them alone", () => with_page("both", { hash: "#t=10.0002" }, async page => {
    assert.ok(await colors(page, 0, 0.49) >= 5 && await colors(page, 0.51, 1) >= 5);
    // Lines of receptions that are delivered: two in A, four in B.
    const delivered = "#009e73", [a, b] = [await of_color(page, 0, 0.5, delivered), await of_color(page, 0.5, 1, delivered)];
    assert.ok(a > 0 && b > 1.2 * a, `${a} and ${b}`);
    for (const [act, runs, labels] of [
        [() => page.getByRole("button", { name: "A", exact: true }).click(), "A", ["A: rescue"]],
        [() => page.getByRole("button", { name: "B", exact: true }).click(), "B", [`B: rescue, with ${radio}`]],
        [() => page.getByRole("button", { name: "A | B" }).click(), "AB", ["A: rescue", `B: rescue, with ${radio}`]],
        [() => page.keyboard.press("b"), "B", [`B: rescue, with ${radio}`]],
        [() => page.keyboard.press("b"), "A", ["A: rescue"]],
        [() => page.keyboard.press("a"), "B", [`B: rescue, with ${radio}`]],
        [() => page.keyboard.press("s"), "AB", ["A: rescue", `B: rescue, with ${radio}`]]]) {
        await act();
        await drawn(page);
        assert.equal((await state(page)).runs, runs);
        assert.deepEqual((await page.locator("#labels span").allInnerTexts()).filter(Boolean), labels);
        assert.ok(await colors(page, 0, 1) >= 5);
    }
}));

test("view page, two runs: a click on a difference selects its time, robot and message, and marks the robot on both maps", () => with_page("both", {}, async page => {
    const button = page.locator("#compare-panel li button").first();
    assert.equal(await button.innerText(), "message 0 at D");
    await button.click();
    await drawn(page);
    const { t, robots, message } = await state(page);
    assert.deepEqual({ robots, message }, { robots: [3], message: 0 });
    assert.ok(t > 10e9 && t < 10.001e9, `${t}`);
    // The sign of a gain is blue, left above the robot, on both maps.
    const before = await Promise.all([0, 0.5].map(from => of_color(page, from, from + 0.5, "#0072b2")));
    await page.evaluate(() => window.rovernet.select({ message: 1 }));
    await drawn(page);
    const after = await Promise.all([0, 0.5].map(from => of_color(page, from, from + 0.5, "#0072b2")));
    for (const i of [0, 1]) assert.ok(before[i] - after[i] > 100, `${before} ${after}`);
    await page.evaluate(() => window.rovernet.select({ message: 0 }));
    await drawn(page);
    assert.match(await page.locator("#legend").innerText(), /gained: in run B only/);
}));

test("view page, two runs: a copied address restores the shown run, time, panel and message", async () => {
    let hash = "";
    await with_page("both", {}, async page => {
        await page.keyboard.press("b");
        await page.evaluate(() => window.rovernet.select({ t: 16e9, panel: "message", message: 2 }));
        await page.waitForTimeout(500);
        hash = new URL(page.url()).hash;
    });
    await with_page("both", { hash }, async page => {
        const { runs, panel, message, t } = await state(page);
        assert.deepEqual({ runs, panel, message, t }, { runs: "B", panel: "message", message: 2, t: 16e9 });
        await page.waitForFunction(() => document.getElementById("message-panel").textContent.includes("4 of 4 robots got it"));
        await page.keyboard.press("a");
        await page.keyboard.press("a");
        await page.keyboard.press("a");
        await page.waitForFunction(() => document.getElementById("message-panel").textContent.includes("3 of 4 robots got it"));
    });
});

test("view page, two runs: after a switch to the other run the same message is selected, even if it has another number there", () => with_page("routes-both", {}, async page => {
    const kinds = [...sections(view_file("routes-both")).unpacked.get("messages.kind")], last = kinds.lastIndexOf(0), facts = page.locator("#message-panel .facts").first();
    await page.evaluate(message => window.rovernet.select({ runs: "A", panel: "message", message }), last);
    const told = await facts.innerText();
    await page.keyboard.press("b");
    await page.waitForFunction(message => window.rovernet.state.message !== message, last);
    await drawn(page);
    assert.equal(await facts.innerText(), told);
    await page.keyboard.press("b");
    assert.equal((await state(page)).message, last);
}));

for (const colorScheme of ["light", "dark"]) {
    test(`view page, two runs: in ${colorScheme} colours no accessibility rule of WCAG 2 A or AA is violated`, () => with_page("both", { context: { colorScheme, bypassCSP: true }, hash: "#t=10.0002&robots=0,4&message=0&panel=compare" }, async page => {
        await page.evaluate(fs.readFileSync(path.join(folder, "node_modules/axe-core/axe.min.js"), "utf8"));
        for (const panel of ["compare", "message"]) {
            await page.evaluate(chosen => window.rovernet.select({ panel: chosen }), panel);
            await drawn(page);
            const { violations } = await page.evaluate(() => window.axe.run({ runOnly: ["wcag2a", "wcag2aa"] }));
            assert.deepEqual(violations.map(v => `${panel}: ${v.id}: ${v.nodes[0].html}`), []);
        }
    }));
}

test("view page, two runs: at 1024 x 640 the page needs no scrolling, and no text is cut off", () => with_page("both", { context: { viewport: { width: 1024, height: 640 } } }, async page => {
    const { wide, high } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, high: document.documentElement.scrollHeight }));
    assert.ok(wide <= 1024 && high <= 640, `${wide} x ${high}`);
    const [label, zooms] = await Promise.all(["#labels span:last-child", "#zooms"].map(place => page.locator(place).boundingBox()));
    const text = await page.locator("#labels span:last-child").evaluate(span => span.scrollWidth);
    assert.ok(label.x + Math.min(text, label.width - 40) <= zooms.x);
    const cut = await page.evaluate(() => [...document.querySelectorAll("#name, #caption, #labels span")].filter(e => e.scrollWidth > e.clientWidth || e.scrollHeight > e.clientHeight + 2).map(e => e.textContent));
    assert.deepEqual(cut, []);
}));

test("view page, two runs: each of the two maps shows the links of its own run", () => with_command(["view", path.join(folder, "rescue"), "--with", radio], address => with_served(address, {}, async page => {
    await page.evaluate(() => window.rovernet.select({ t: 10e9, links: true }));
    await page.waitForFunction(() => links_shown(0).length > 0 && links_shown(1).length > 0);
    for (const [i, set] of [[0, []], [1, ["--set", radio]]]) {
        const robots = told("links", scenario("rescue"), "--at", "10s", ...set, "--json").robots ?? told("links", scenario("rescue"), "--at", "10s", ...set, "--json");
        const names = await page.evaluate(() => rovernet.parts.sides.own.all[0].run.head.robots.map(robot => robot.name));
        const pairs = await page.evaluate(run => links_shown(run).map(l => [l.from, l.to]), i);
        const expected = new Set(robots.flatMap(one => one.links.map(link => [one.robot, link.robot].sort().join())));
        assert.deepEqual(new Set(pairs.map(pair => pair.map(robot => names[robot]).sort().join())), expected);
        assert.ok(pairs.length > 1);
    }
})));

// SPDX-License-Identifier: MIT
// Page in a browser: what it shows is what the command line prints; no error, no request, no rule of access broken.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { colors, drawn, folder, most_apart, told, trace, with_page } from "./page.mjs";
import { sections, view_file } from "./run_file.mjs";

const all = ["rescue", "storeys", "routes", "patrol", "search", "csma", "hostile"];

for (const name of all) {
    test(`view page: the page of ${name} loads no other file, and draws a map with a legend`, () => with_page(name, {}, async page => {
        assert.ok(await colors(page) >= 5);
        assert.ok(await page.locator("#legend .item").count() >= 2);
    }));
}

for (const name of ["rescue", "storeys", "patrol"]) {
    test(`view page: the page of ${name} shows robots at the positions that rovernet where prints`, () => with_page(name, {}, async page => {
        const most = await most_apart(page, name, sections(view_file(name)).head.duration_ns, 200);
        assert.ok(most < 1e-3, `${most} m apart`);
    }));
}

for (const name of ["rescue", "csma"]) {
    test(`view page: for each message of ${name}, the page and the command trace follow agree on which robots have it`, () => with_page(name, {}, async page => {
        const { head, unpacked } = sections(view_file(name)), part = unpacked.get("messages.uid");
        const uids = [...new Float64Array(part.buffer.slice(part.byteOffset, part.byteOffset + part.length))].slice(0, 12);
        for (const uid of uids) {
            const has = new Set(told("trace", "follow", trace(name), "--message", String(uid), "--json").robots.map(row => row.robot));
            const found = await page.evaluate(async ({ uid, count }) => Promise.all(Array.from({ length: count }, (_, i) => outcome(uid, i))), { uid, count: head.robots.length });
            head.robots.forEach((robot, i) => assert.equal(["origin", "delivered", "received"].includes(found[i]), has.has(robot.name), `message ${uid} at ${robot.name}: ${found[i]}`));
        }
    }));
}

test("view page: why a robot missed a message is explained in the same words as by the command trace follow", () => with_page("rescue", {}, async page => {
    const { head } = sections(view_file("rescue")), [{ message, robot }] = head.follow;
    const answer = told("trace", "follow", trace("rescue"), "--message", String(message), "--robot", head.robots[robot].name, "--json").at_robot.answer;
    assert.equal(head.follow[0].text, answer);
    await page.evaluate(index => window.rovernet.select({ message: index, panel: "message" }), message);
    await page.waitForFunction(text => document.getElementById("message-panel").textContent.includes(text), answer.slice(head.robots[robot].name.length + 1, 60));
}));

/** Ends of the receptions of a run [ns], read without the page's code. */
function reception_ends(name) {
    const { head, unpacked } = sections(view_file(name)), out = [];
    const numbers = (column, Type) => new Type(Uint8Array.from(unpacked.get(column)).buffer);
    for (let n = 0; n < head.blocks.length; n++) {
        const parts = numbers(`${n}/flights.start`, Uint32Array), airtime = numbers(`${n}/flights.airtime`, Float64Array), count = numbers(`${n}/flights.count`, Uint32Array);
        let t = 0;
        for (let i = 0; i < count.length; i++) {
            t += parts[i] + 2 ** 32 * parts[count.length + i];
            for (let k = 0; k < count[i]; k++) out.push(t + airtime[i]);
        }
    }
    return out;
}

test("view page: the time line counts every reception, at each zoom level", () => with_page("csma", {}, async page => {
    const { counts, blocks, density, duration_ns } = sections(view_file("csma")).head, ends = reception_ends("csma"), bar = 3;
    assert.equal(ends.length, counts.receptions);
    const width = (await page.locator("#timeline").boundingBox()).width;
    const sums = spans => page.evaluate(all => all.map(span => {
        window.rovernet.select({ span });
        return window.rovernet.density().reduce((sum, column) => sum + column.reduce((x, y) => x + y, 0), 0);
    }), spans);
    assert.deepEqual(await sums([null]), [counts.receptions]);
    const levels = new Set();
    for (let parts = 2; parts <= 128; parts *= 2) {
        const pixel = duration_ns / parts / width * bar, fitting = density.filter(level => level.width_ns <= pixel), bin = Math.max(...fitting.map(level => level.width_ns));
        if (fitting.length === 0) continue;
        levels.add(bin);
        const length = Math.ceil(duration_ns / parts / bin) * bin, spans = Array.from({ length: parts }, (_, i) => ({ from: i * length, to: (i + 1) * length }));
        const expected = spans.map(({ from, to }) => ends.filter(end => end >= from && end < to).length);
        assert.deepEqual(await sums(spans), expected, `${parts} parts`);
    }
    assert.equal(levels.size, density.length);
    const from = blocks[0].begin_ns;
    await page.evaluate(span => window.rovernet.select({ span }), { from, to: from + 5e6 });
    await drawn(page);
}));

test("view page: a seek takes at most 15 ms of CPU time in scripts, and the page at most 150 MB of memory", () => with_page("many", { fresh: true }, async (page, context) => {
    const { blocks, duration_ns } = sections(view_file("many")).head;
    assert.ok(blocks.length > 1);
    for (const { begin_ns } of blocks) {
        await page.evaluate(t => window.rovernet.seek(t), begin_ns);
        await page.waitForFunction(() => window.rovernet.whole && window.rovernet.list());
    }
    const cdp = await context.newCDPSession(page), seeks = 40;
    await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
    // CPU time, as other programs may have the machine, too.
    const script = async () => (await cdp.send("Performance.getMetrics")).metrics.find(metric => metric.name === "ScriptDuration").value;
    const begin = await script();
    await page.evaluate(async ({ end, count }) => {
        for (let i = 1; i <= count; i++) {
            const { frames } = window.rovernet;
            window.rovernet.seek((i * 0.618034 % 1) * end);
            while (window.rovernet.frames === frames) await new Promise(done => requestAnimationFrame(done));
        }
    }, { end: duration_ns, count: seeks });
    const taken = 1e3 * (await script() - begin) / seeks;
    assert.ok(taken <= 15, `${taken} ms`);
    await cdp.send("HeapProfiler.collectGarbage");
    const { usedSize, backingStorageSize } = await cdp.send("Runtime.getHeapUsage");
    assert.ok(usedSize + backingStorageSize <= 150e6, `${usedSize} + ${backingStorageSize} bytes`);
}));

test("view page, list of events: while a run plays, the list follows the time, also from one block of data to the next", () => with_page("many", {}, async page => {
    const { blocks } = sections(view_file("many")).head, begin = blocks[1].begin_ns;
    await page.evaluate(t => window.rovernet.select({ t, playing: false }), begin - 0.2e9);
    await page.waitForFunction(() => window.rovernet.whole && window.rovernet.list());
    await page.keyboard.press("k");
    await page.waitForFunction(t => window.rovernet.state.playing && window.rovernet.t > t && window.rovernet.list()?.time > t, begin);
    await page.keyboard.press("k");
    await drawn(page);
    const { list, t } = await page.evaluate(() => ({ list: window.rovernet.list(), t: window.rovernet.t }));
    assert.ok(list.time <= t && list.time > t - 0.1e9);
}));

test("view page, list of events: the first row is the latest event at or before the current time", () => with_page("csma", {}, async page => {
    const rows = () => page.evaluate(() => {
        const box = document.getElementById("events").getBoundingClientRect();
        const seen = [...document.querySelectorAll("#events .row")].filter(row => row.getBoundingClientRect().bottom > box.top + 12)
            .sort((a, b) => a.getBoundingClientRect().top - b.getBoundingClientRect().top);
        return seen.slice(0, 2).map(row => Number(row.querySelector(".when").textContent.replace(/\s/g, "")));
    });
    for (const t of [1.5e9, 5e9, 12.3e9, 19.9e9]) {
        await page.evaluate(at => window.rovernet.seek(at), t);
        await drawn(page);
        const { time, text } = await page.evaluate(() => window.rovernet.list()), [first, second] = await rows();
        assert.ok(time <= t && text);
        assert.equal(first, Math.floor(time / 1e3) / 1e6);
        if (second !== undefined) assert.ok(second * 1e9 > t - 1e3);
    }
    for (const speed of [1e-6, 1, 1e3]) {
        await page.evaluate(value => window.rovernet.select({ speed: value, t: 1e9 }), speed);
        await page.keyboard.press(" ");
        await page.waitForFunction(() => window.rovernet.t > 1e9);
        await page.evaluate(() => window.rovernet.select({ playing: false }));
        await drawn(page);
        const { list, t } = await page.evaluate(() => ({ list: window.rovernet.list(), t: window.rovernet.t }));
        assert.ok(list.time <= t && t > 1e9);
        const [first] = await rows();
        assert.equal(first, Math.floor(list.time / 1e3) / 1e6);
    }
    await page.evaluate(() => window.rovernet.select({ panel: "robot", robots: [2], t: 7e9 }));
    await drawn(page);
    await page.waitForFunction(() => document.querySelectorAll("#robot-messages button").length > 5);
    await page.keyboard.press("1");
    await drawn(page);
    assert.equal((await rows())[0], Math.floor((await page.evaluate(() => window.rovernet.list().time)) / 1e3) / 1e6);
    for (let i = 0; i < 3; i++) {
        const before = await page.evaluate(() => window.rovernet.t);
        await page.keyboard.press("ArrowLeft");
        await drawn(page);
        const { t, list } = await page.evaluate(() => ({ t: window.rovernet.t, list: window.rovernet.list() }));
        assert.ok(t < before && list.time === t);
    }
}));

test("view page, list of events: after 11 simulated days, events one nanosecond apart are still listed in order", () => with_page("late", {}, async page => {
    const { unpacked } = sections(view_file("late")), created = [...new Float64Array(Uint8Array.from(unpacked.get("messages.created")).buffer)];
    assert.deepEqual(created.slice(0, 2), [1e15, 1e15 + 1]);
    await page.evaluate(() => window.rovernet.select({ speed: 1e-6 }));
    for (const [t, expected] of [[1e15 - 1, null], [1e15, 1e15], [1e15 + 1, 1e15 + 1], [created[2] - 1, null], [created[2], created[2]], [created[3], created[3]]]) {
        await page.evaluate(at => window.rovernet.seek(at), t);
        await drawn(page);
        const seen = await page.evaluate(() => window.rovernet.list());
        if (expected === null) assert.ok(seen === null || seen.time < t);
        else assert.equal(seen.time, expected);
        assert.equal((await page.locator("#time").textContent()).replace(/\D/g, ""), `${BigInt(t)}`.padStart(10, "0"));
    }
    const times = [...new Set([...created, ...reception_ends("late")])].sort((a, b) => a - b).slice(0, 12);
    await page.evaluate(() => window.rovernet.seek(0));
    const stepped = [];
    while (stepped.length < 30 && (stepped.at(-1) ?? 0) < times.at(-1)) {
        const before = await page.evaluate(() => window.rovernet.t);
        await page.keyboard.press("ArrowRight");
        await page.waitForFunction(t => window.rovernet.t > t, before);
        stepped.push(await page.evaluate(() => window.rovernet.t));
    }
    for (const t of times) assert.ok(stepped.includes(t), `${t} was left out of ${stepped}`);
}));

test("view page: keys alone control time, speed, selection, zoom, panels and help", () => with_page("rescue", {}, async page => {
    const state = () => page.evaluate(() => structuredClone(window.rovernet.state));
    const press = async key => { await page.keyboard.press(key); await drawn(page); };
    await press("Shift+ArrowRight");
    assert.equal((await state()).t, 1e9);
    await press("ArrowRight");
    assert.ok((await state()).t > 1e9);
    await press("Alt+ArrowRight");
    assert.equal((await page.evaluate(() => window.rovernet.list().text)).includes("→"), true);
    await press("f");
    assert.equal((await state()).message, 0);
    await page.waitForFunction(() => document.querySelector("#message-panel h2")?.textContent === "message 0");
    await press("/");
    await page.keyboard.type("E");
    await page.keyboard.press("Enter");
    assert.deepEqual((await state()).robots, [4]);
    assert.equal(await page.locator("#robot-panel h2").textContent(), "E");
    await press("c");
    assert.match(await page.locator("#status").textContent(), /rovernet view RUN/);
    await press("4");
    await press("/");
    await page.keyboard.type("A");
    await page.keyboard.press("Enter");
    assert.deepEqual((await state()).robots, [4, 0]);
    assert.equal(await page.locator("#pair-panel h2").textContent(), "E and A");
    await press("]");
    assert.ok((await state()).speed > 3);
    await press("+");
    assert.ok((await state()).view.scale > 0);
    await press("0");
    assert.equal((await state()).view, null);
    await press("End");
    assert.equal((await state()).t, 90e9);
    await press("Home");
    assert.equal((await state()).t, 0);
    await page.keyboard.press("?");
    assert.ok(await page.locator("#help").isVisible());
    await page.keyboard.press("Escape");
    await page.locator("#help").waitFor({ state: "hidden" });
    await page.keyboard.press("k");
    await page.waitForFunction(() => window.rovernet.t > 0);
    await page.keyboard.press("k");
    assert.equal((await state()).playing, false);
}));

for (const colorScheme of ["light", "dark"]) {
    test(`view page: in ${colorScheme} colours no accessibility rule of WCAG 2 A or AA is violated`, () => with_page("csma", { context: { colorScheme, bypassCSP: true }, hash: "#t=5&robots=0,1&message=3" }, async page => {
        await page.addScriptTag({ path: path.join(folder, "node_modules/axe-core/axe.min.js") }).catch(async () => {
            await page.evaluate(fs.readFileSync(path.join(folder, "node_modules/axe-core/axe.min.js"), "utf8"));
        });
        for (const panel of ["events", "message", "robot", "pair", "charts"]) {
            await page.evaluate(chosen => window.rovernet.select({ panel: chosen }), panel);
            await drawn(page);
            const { violations } = await page.evaluate(() => window.axe.run({ runOnly: ["wcag2a", "wcag2aa"] }));
            assert.deepEqual(violations.map(v => `${panel}: ${v.id}: ${v.nodes[0].html}`), []);
        }
    }));
}

test("view page: while the run is not playing, the page redraws nothing, with and without reduced motion", async () => {
    for (const reducedMotion of ["no-preference", "reduce"]) {
        await with_page("rescue", { context: { reducedMotion } }, async page => {
            await page.waitForTimeout(500);
            const begin = await page.evaluate(() => window.rovernet.frames);
            await page.waitForTimeout(1000);
            assert.equal(await page.evaluate(() => window.rovernet.frames), begin);
        });
    }
});

test("view page: a copied address restores time, speed, storey, robots, message, panel, filter and view", async () => {
    const chosen = { t: 13106000001, speed: 0.01, storey: 1, robots: [2, 1], message: 3, panel: "message", trails: false, all: true };
    let hash = "";
    await with_page("storeys", {}, async page => {
        await page.evaluate(state => window.rovernet.select({ ...state, filter: { robot: 1, message: -1, signs: 1, kinds: 24 }, view: { x: 3, y: 4, scale: 20 } }), chosen);
        await page.waitForTimeout(500);
        hash = new URL(page.url()).hash;
    });
    await with_page("storeys", { hash }, async page => {
        const state = await page.evaluate(() => structuredClone(window.rovernet.state));
        for (const [key, value] of Object.entries(chosen)) assert.deepEqual(state[key], value, key);
        assert.deepEqual(state.filter, { robot: 1, message: -1, signs: 1, kinds: 24 });
        assert.deepEqual(state.view, { x: 3, y: 4, scale: 20 });
    });
});

test("view page: names and payloads that contain HTML are shown as text", () => with_page("hostile", { hash: "#t=1.5&robots=0" }, async page => {
    for (const panel of ["events", "message", "robot", "pair"]) {
        await page.evaluate(chosen => window.rovernet.select({ panel: chosen, message: 0 }), panel);
        await drawn(page);
    }
    await page.locator("#search").fill("img");
    await page.waitForTimeout(200);
    assert.match(await page.title(), /^<b>hostile<img/);
    assert.equal(await page.locator("img, b").count(), 0);
    assert.equal(await page.locator("body script").count(), 1);
    const text = await page.locator("body").innerText();
    assert.ok(text.includes("<img src=x"));
    assert.ok(!text.includes("\u202e"));
}));

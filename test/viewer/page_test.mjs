// SPDX-License-Identifier: MIT
// Page in a browser: what it shows is what the command line prints; no error, no request, no rule of access broken.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import test, { after, before } from "node:test";
import { chromium } from "playwright-core";
import { sections, view_file } from "./run_file.mjs";

const { FOLDER: folder, COMMAND: command, CHROMIUM: browser_path } = process.env;
const all = ["rescue", "storeys", "routes", "patrol", "search", "csma", "hostile"];
let browser;

before(async () => {
    browser = await chromium.launch({ executablePath: browser_path, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
});
after(() => browser.close());

/** JSON that the command prints. */
function told(...words) { return JSON.parse(execFileSync(command, words, { maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] })); }

/** Scenario of a run. */
function scenario(name) { return fs.readFileSync(path.join(folder, name, "scenario.path"), "utf8").trim(); }

/** Opens the page of a run that is served, does something, and holds it to be free of errors. */
async function with_served(name, hash, act) {
    const server = spawn(command, ["view", path.join(folder, name), "--address", "127.0.0.1:0"], { stdio: ["ignore", "pipe", "ignore"] });
    const page = await browser.newPage({ viewport: { width: 1280, height: 720 } }), faults = [];
    page.on("console", message => { if (["error", "warning"].includes(message.type())) faults.push(message.text()); });
    page.on("pageerror", error => faults.push(error.message));
    try {
        const address = await new Promise(done => server.stdout.on("data", text => { const found = /http:\S+/.exec(text); if (found) done(found[0]); }));
        await page.goto(address + hash);
        await page.waitForFunction(() => window.rovernet && (window.rovernet.error || window.rovernet.ready && window.rovernet.frames > 0));
        await act(page);
        assert.deepEqual(faults, []);
    } finally {
        await page.close();
        server.kill("SIGINT");
    }
}

/** Opens a page with the network off, does something, and holds it to be free of errors. */
async function with_page(name, options, act) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, offline: true, ...options.context });
    context.setDefaultTimeout(15000);
    const page = await context.newPage(), faults = [], requests = [];
    page.on("console", message => { if (["error", "warning"].includes(message.type())) faults.push(message.text()); });
    page.on("pageerror", error => faults.push(error.message));
    page.on("dialog", dialog => { faults.push("a dialog"); dialog.dismiss(); });
    page.on("request", request => requests.push(request.url()));
    await page.addInitScript(() => document.addEventListener("securitypolicyviolation", event => console.error(`violates ${event.violatedDirective}`)));
    await page.goto(`file://${folder}/${name}.html${options.hash ?? ""}`);
    await page.waitForFunction(() => window.rovernet && (window.rovernet.error || window.rovernet.ready && window.rovernet.frames > 0));
    try {
        await act(page);
        assert.equal(await page.evaluate(() => window.rovernet.error), "");
        assert.deepEqual(faults, []);
        assert.deepEqual(requests.filter(url => !url.startsWith("file:") && !url.startsWith("blob:")), []);
        assert.equal(requests.filter(url => url.startsWith("file:")).length, 1);
    } finally {
        await context.close();
    }
}

/** Waits until what was asked for is drawn. */
async function drawn(page) {
    await page.evaluate(async () => {
        const begin = window.rovernet.frames;
        for (let i = 0; i < 200 && (window.rovernet.frames === begin || !window.rovernet.whole); i++) await new Promise(done => setTimeout(done, 10));
    });
}

/** Number of colours of the map. */
function colors(page) {
    return page.evaluate(() => {
        const canvas = document.getElementById("map"), seen = new Set();
        const pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
        for (const pixel of pixels) seen.add(pixel);
        return seen.size;
    });
}

for (const name of all) {
    test(`V1: ${name} opens by itself, with colours on its map`, () => with_page(name, {}, async page => {
        assert.ok(await colors(page) >= 5);
        assert.ok(await page.locator("#legend .item").count() >= 2);
    }));
}

for (const name of ["rescue", "storeys", "patrol"]) {
    test(`V2: robots of ${name} are where the command says`, () => with_page(name, {}, async page => {
        const { duration_ns } = sections(view_file(name)).head;
        const times = Array.from({ length: 200 }, (_, i) => Math.round((i * 0.618034 % 1) * duration_ns / 1e3) * 1e3).sort((a, b) => a - b);
        const truth = told("where", scenario(name), "--at", times.map(t => `${t / 1e9}s`).join(","), "--json").times;
        const found = await page.evaluate(asked => asked.map(({ t, count }) => {
            window.rovernet.seek(t);
            return Array.from({ length: count }, (_, i) => window.rovernet.position(i));
        }), truth.map((row, i) => ({ t: times[i], count: row.robots.length })));
        let most = 0;
        truth.forEach((row, i) => row.robots.forEach((robot, k) => {
            if (robot.presence === "not departed" || robot.presence === "left") return;
            most = Math.max(most, Math.hypot(robot.x_m - found[i][k].x, robot.y_m - found[i][k].y, robot.z_m - found[i][k].z));
        }));
        assert.ok(most < 1e-3, `${most} m apart`);
    }));
}

for (const name of ["rescue", "csma"]) {
    test(`V3: who has which message of ${name} is what trace follow says`, () => with_page(name, {}, async page => {
        const { head, unpacked } = sections(view_file(name)), part = unpacked.get("messages.uid");
        const uids = [...new Float64Array(part.buffer.slice(part.byteOffset, part.byteOffset + part.length))].slice(0, 12);
        for (const uid of uids) {
            const has = new Set(told("trace", "follow", path.join(folder, name, "trace.mcap"), "--message", String(uid), "--json").robots.map(row => row.robot));
            const found = await page.evaluate(async ({ uid, count }) => Promise.all(Array.from({ length: count }, (_, i) => window.rovernet.outcome(uid, i))), { uid, count: head.robots.length });
            head.robots.forEach((robot, i) => assert.equal(["origin", "delivered", "received"].includes(found[i]), has.has(robot.name), `message ${uid} at ${robot.name}: ${found[i]}`));
        }
    }));
}

test("V3: the page says why a robot has not got a message, in the words of trace follow", () => with_page("rescue", {}, async page => {
    const { head } = sections(view_file("rescue")), [{ message, robot }] = head.follow;
    const answer = told("trace", "follow", path.join(folder, "rescue/trace.mcap"), "--message", String(message), "--robot", head.robots[robot].name, "--json").at_robot.answer;
    assert.equal(head.follow[0].text, answer);
    await page.evaluate(index => window.rovernet.select({ message: index, panel: "message" }), message);
    await page.waitForFunction(text => document.getElementById("message-panel").textContent.includes(text), answer.slice(head.robots[robot].name.length + 1, 60));
}));

test("V4: the time line shows every reception, and the frames when it is close", () => with_page("csma", {}, async page => {
    const { counts, blocks } = sections(view_file("csma")).head;
    const sum = await page.evaluate(() => window.rovernet.density().reduce((a, column) => a + column.reduce((x, y) => x + y, 0), 0));
    assert.equal(sum, counts.receptions);
    const from = blocks[0].begin_ns;
    await page.evaluate(span => window.rovernet.select({ span }), { from, to: from + 5e6 });
    await drawn(page);
}));

test("V5: a seek takes at most 10 ms of script", () => with_page("csma", {}, async page => {
    const median = await page.evaluate(async () => {
        const taken = [];
        for (let i = 1; i <= 100; i++) {
            const { frames } = window.rovernet;
            window.rovernet.seek((i * 0.618034 % 1) * 20e9);
            for (let k = 0; k < 500 && window.rovernet.frames === frames; k++) await new Promise(done => setTimeout(done, 2));
            taken.push(window.rovernet.scriptMs.at(-1));
        }
        return taken.sort((a, b) => a - b)[50];
    });
    assert.ok(median <= 10, `${median} ms`);
}));

test("V6: the first row of the list is the last event until now", () => with_page("csma", {}, async page => {
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
        await page.waitForTimeout(150);
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

/** Number of pixels of the map with a colour, "#rrggbb". */
function pixels_of(page, color) {
    return page.evaluate(hex => {
        const canvas = document.getElementById("map"), copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
        const wanted = [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16));
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
        let n = 0;
        for (let i = 0; i < data.length; i += 4) if (wanted.every((v, k) => Math.abs(data[i + k] - v) <= 24)) n++;
        return n;
    }, color);
}

test("V8: the level under the pointer is the coverage there, and the difference of two models is told", () => with_served("rescue", "#t=10&robots=1&panel=robot", async page => {
    await page.keyboard.press("c");
    await page.waitForFunction(() => document.getElementById("legend").textContent.includes("coverage of B"));
    const box = await page.locator("#map").boundingBox();
    const hover = async robot => {
        const [x, y] = await page.evaluate(i => window.rovernet.pixel(i), robot);
        await page.mouse.move(box.x + x, box.y + y);
        return page.locator("#status").textContent();
    };
    const number = text => Number(/^[\u2212\d.]+/.exec(text)[0].replace("\u2212", "-"));
    for (const [index, name] of [[0, "A"], [2, "C"]]) {
        const link = told("link", scenario("rescue"), "B", name, "--at", "10", "--json"), text = await hover(index);
        assert.ok(Math.abs(number(text) - link.rx_power_dbm) < 2, `${name}: ${text}, ${link.rx_power_dbm}`);
    }
    const cells = await page.evaluate(() => window.rovernet.levels());
    for (let i = 7; i < cells.length; i += Math.ceil(cells.length / 40)) {
        await page.mouse.move(box.x + cells[i].x, box.y + cells[i].y);
        const text = await page.locator("#status").textContent();
        assert.ok(Math.abs(number(text) - cells[i].dbm) <= 0.0501, `${text}, ${cells[i].dbm}`);
    }
    assert.ok(await pixels_of(page, "#00501e") > 200, "contours are drawn");
    await page.locator("#robot-panel select").selectOption("friis");
    await page.waitForFunction(() => document.getElementById("legend").textContent.includes("friis \u2212"));
    assert.match(await hover(4), /^\u2212[\d.]+ dBm, friis \u2212[\d.]+ dBm \(\+[\d.]+ dB\)$/);
}));

test("links: their number and colours are those of the command, and they are asked again at another time", () => with_served("rescue", "#t=10", async page => {
    await page.keyboard.press("l");
    for (const at of [10, 40]) {
        const tables = told("links", scenario("rescue"), "--at", String(at), "--json"), pairs = new Set();
        for (const { robot, links } of tables.robots) for (const link of links) pairs.add([robot, link.robot].sort().join());
        await page.evaluate(t => window.rovernet.seek(t), at * 1e9);
        await page.waitForFunction(text => document.getElementById("legend").textContent.includes(text), `link margin [dB] at ${at}.000 s`);
        await drawn(page);
        const links = await page.evaluate(() => window.rovernet.links());
        assert.equal(links.length, pairs.size);
        for (const link of links) {
            const grade = [[30, 3.6], [20, 3], [10, 2.4], [5, 1.8], [0, 1.3]].find(([from]) => link.margin >= from);
            assert.equal(link.width, grade[1]);
            const [[x0, y0], [x1, y1]] = await page.evaluate(ends => ends.map(robot => window.rovernet.pixel(robot)), [link.from, link.to]);
            if (Math.hypot(x1 - x0, y1 - y0) > 60) assert.ok(await pixels_of(page, link.color) > 20, `${link.color} is drawn`);
        }
    }
    await page.evaluate(() => window.rovernet.select({ robots: [0] }));
    await page.waitForFunction(() => window.rovernet.links().every(l => l.from === 0 || l.to === 0));
}));

test("links: a written page has those that the trace tells, and says so", () => with_page("linked", { hash: "#t=20&links=1" }, async page => {
    const tables = told("links", scenario("linked"), "--at", "20", "--json"), pairs = new Set();
    for (const { robot, links } of tables.robots) for (const link of links) pairs.add([robot, link.robot].sort().join());
    assert.equal((await page.evaluate(() => window.rovernet.links())).length, pairs.size);
    assert.match(await page.locator("#legend").textContent(), /link up by the trace/);
}));

test("charts: they end at the metrics; the cursor is the time, a click seeks, a drag zooms", () => with_page("linked", { hash: "#panel=charts" }, async page => {
    const { metrics, duration_ns } = sections(view_file("linked")).head;
    const at = t => page.evaluate(ns => window.rovernet.charts(ns), t), value = (all, chart) => all.find(c => c.chart === chart).values[0].value;
    assert.equal(value(await at(duration_ns), "Delivery ratio"), metrics.delivery_ratio);
    for (const chart of ["Latency of deliveries", "Receptions", "Channel occupancy", "Neighbours of a robot", "Parts of the network"]) value(await at(0), chart);
    const canvas = page.locator("#charts-panel canvas.chart").first(), box = await canvas.boundingBox(), left = 40;
    const cursor = () => canvas.evaluate(c => {
        const copy = new OffscreenCanvas(c.width, c.height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(c, 0, 0);
        const row = copy.getImageData(0, 20, c.width, 1).data;
        for (let x = c.width - 1; x >= 40; x--) if (row[4 * x] < 60 && row[4 * x + 1] < 60 && row[4 * x + 2] < 60 && row[4 * x + 3] > 200) return x;
        return -1;
    });
    for (const share of [0.25, 0.6]) {
        await page.evaluate(t => window.rovernet.seek(t), share * duration_ns);
        await drawn(page);
        assert.ok(Math.abs(await cursor() - (left + share * (box.width - left))) <= 2);
    }
    await canvas.click({ position: { x: left + 0.5 * (box.width - left), y: 40 } });
    assert.ok(Math.abs(await page.evaluate(() => window.rovernet.t) - duration_ns / 2) < duration_ns / 200);
    await page.mouse.move(box.x + left + 0.25 * (box.width - left), box.y + 40);
    await page.mouse.down();
    await page.mouse.move(box.x + left + 0.5 * (box.width - left), box.y + 40, { steps: 4 });
    await page.mouse.up();
    const span = await page.evaluate(() => window.rovernet.state.span);
    assert.ok(Math.abs(span.from - 0.25 * duration_ns) < duration_ns / 100 && Math.abs(span.to - 0.5 * duration_ns) < duration_ns / 100);
}));

test("storeys: with All, a click finds a robot of another storey", () => with_page("storeys", { hash: "#t=10" }, async page => {
    const box = await page.locator("#map").boundingBox(), [x, y] = await page.evaluate(() => window.rovernet.pixel(1));
    const click = async () => {
        await page.mouse.click(box.x + x, box.y + y);
        await drawn(page);
        return page.evaluate(() => window.rovernet.state.robots);
    };
    assert.deepEqual(await click(), []);
    await page.getByRole("button", { name: "All", exact: true }).click();
    assert.deepEqual(await click(), [1]);
}));

test("V15: a tour by keys alone", () => with_page("rescue", {}, async page => {
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
    await page.evaluate(() => document.activeElement.blur());
    await press("c");
    assert.match(await page.locator("#status").textContent(), /rovernet view RUN/);
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
    test(`V15: no rule of access is broken, ${colorScheme}`, () => with_page("csma", { context: { colorScheme, bypassCSP: true }, hash: "#t=5&robots=0,1&message=3" }, async page => {
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

test("V15: nothing is drawn while the run stands, with and without reduced motion", async () => {
    for (const reducedMotion of ["no-preference", "reduce"]) {
        await with_page("rescue", { context: { reducedMotion } }, async page => {
            await page.waitForTimeout(500);
            const begin = await page.evaluate(() => window.rovernet.frames);
            await page.waitForTimeout(1000);
            assert.equal(await page.evaluate(() => window.rovernet.frames), begin);
        });
    }
});

test("V16: an address restores what was shown", async () => {
    const chosen = { t: 13106000001, speed: 0.01, storey: 1, robots: [2, 1], message: 3, panel: "message", trails: false };
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

test("V18: hostile names and payloads are shown as text", () => with_page("hostile", { hash: "#t=1.5&robots=0" }, async page => {
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

test("small: nothing is cut off at 1024 x 640", () => with_page("csma", { context: { viewport: { width: 1024, height: 640 } } }, async page => {
    const { wide, high, map } = await page.evaluate(() => ({
        wide: document.documentElement.scrollWidth, high: document.documentElement.scrollHeight, map: document.getElementById("map").clientHeight
    }));
    assert.ok(wide <= 1024 && high <= 640 && map >= 250, `${wide} x ${high}, map ${map}`);
}));

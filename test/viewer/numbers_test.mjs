// SPDX-License-Identifier: MIT
// Links, coverage, charts and storeys in a browser: their numbers are those of the command line.
import assert from "node:assert/strict";
import path from "node:path";
import test from "node:test";
import { drawn, folder, scenario, told, with_page, with_served, with_server } from "./page.mjs";
import { sections, view_file } from "./run_file.mjs";

/** Serves a run, and opens its page. */
function of_run(name, hash, act) { return with_server(path.join(folder, name), address => with_served(address, { hash }, act)); }

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

test("view page, coverage: the page shows the level at the pointer; for two models, both levels and their difference", () => of_run("rescue", "#t=10&robots=1&panel=robot", async page => {
    await page.keyboard.press("c");
    await page.waitForFunction(() => document.getElementById("legend").textContent.includes("coverage of B"));
    const box = await page.locator("#map").boundingBox();
    const hover = async robot => {
        const [x, y] = await page.evaluate(i => pixel(i), robot);
        await page.mouse.move(box.x + x, box.y + y);
        return page.locator("#status").textContent();
    };
    const number = text => Number(/^[\u2212\d.]+/.exec(text)[0].replace("\u2212", "-"));
    for (const [index, name] of [[0, "A"], [2, "C"]]) {
        const link = told("link", scenario("rescue"), "B", name, "--at", "10", "--json"), text = await hover(index);
        assert.ok(Math.abs(number(text) - link.rx_power_dbm) < 2, `${name}: ${text}, ${link.rx_power_dbm}`);
    }
    const cells = await page.evaluate(() => levels());
    for (let i = 7; i < cells.length; i += Math.ceil(cells.length / 40)) {
        await page.mouse.move(box.x + cells[i].x, box.y + cells[i].y);
        const text = await page.locator("#status").textContent();
        assert.ok(Math.abs(number(text) - cells[i].dbm) <= 0.0501, `${text}, ${cells[i].dbm}`);
    }
    assert.ok(await pixels_of(page, "#00501e") > 200, "contours are drawn");
    await page.locator("#robot-panel select").selectOption("friis");
    await page.waitForFunction(() => document.getElementById("legend").textContent.includes("friis \u2212"));
    assert.match(await hover(4), /^\u2212[\d.]+ dBm, friis \u2212[\d.]+ dBm \(\+[\d.]+ dB\)$/);
    await page.waitForFunction(() => /[#&]coverage=1/.test(location.hash));
    await page.reload();
    await page.waitForFunction(() => document.getElementById("legend").textContent.includes("coverage of B"));
    await page.keyboard.press("c");
    await page.waitForFunction(() => !location.hash.includes("coverage"));
}));

test("view page, links: the map shows as many links as rovernet links prints, in line widths by margin, also after a change of time", () => of_run("rescue", "#t=10", async page => {
    await page.keyboard.press("l");
    for (const at of [10, 40]) {
        const tables = told("links", scenario("rescue"), "--at", String(at), "--json"), pairs = new Set();
        for (const { robot, links } of tables.robots) for (const link of links) pairs.add([robot, link.robot].sort().join());
        await page.evaluate(t => window.rovernet.seek(t), at * 1e9);
        await page.waitForFunction(text => document.getElementById("legend").textContent.includes(text), `link margin [dB] at ${at}.000 s`);
        await drawn(page);
        const links = await page.evaluate(() => links_shown());
        assert.equal(links.length, pairs.size);
        for (const link of links) {
            const grade = [[30, 3.6], [20, 3], [10, 2.4], [5, 1.8], [0, 1.3]].find(([from]) => link.margin >= from);
            assert.equal(link.width, grade[1]);
            const [[x0, y0], [x1, y1]] = await page.evaluate(ends => ends.map(robot => pixel(robot)), [link.from, link.to]);
            if (Math.hypot(x1 - x0, y1 - y0) > 60) assert.ok(await pixels_of(page, link.color) > 20, `${link.color} is drawn`);
        }
    }
    await page.evaluate(() => window.rovernet.select({ robots: [0] }));
    await page.waitForFunction(() => links_shown().every(l => l.from === 0 || l.to === 0));
}));

test("view page, links: a page without a server shows the links recorded in the trace, as its legend states", () => with_page("linked", { hash: "#t=20&links=1" }, async page => {
    const tables = told("links", scenario("linked"), "--at", "20", "--json"), pairs = new Set();
    for (const { robot, links } of tables.robots) for (const link of links) pairs.add([robot, link.robot].sort().join());
    assert.equal((await page.evaluate(() => links_shown())).length, pairs.size);
    assert.match(await page.locator("#legend").textContent(), /link up in the trace/);
}));

test("view page, charts: the curve of the delivery ratio ends at the run's metric; a cursor marks the current time, a click seeks, a drag zooms", () => with_page("linked", { hash: "#panel=charts" }, async page => {
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

test("view page, storeys: a click selects a robot of another storey only after the button All is pressed", () => with_page("storeys", { hash: "#t=10" }, async page => {
    const box = await page.locator("#map").boundingBox(), [x, y] = await page.evaluate(() => pixel(1));
    const click = async () => {
        await page.mouse.click(box.x + x, box.y + y);
        await drawn(page);
        return page.evaluate(() => window.rovernet.state.robots);
    };
    assert.deepEqual(await click(), []);
    await page.getByRole("button", { name: "All", exact: true }).click();
    assert.deepEqual(await click(), [1]);
}));

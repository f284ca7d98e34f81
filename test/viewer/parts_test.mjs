// SPDX-License-Identifier: MIT
// Robots that are not there, parts of a run, numbers with all digits, and addresses that nobody would write.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { drawn, folder, printed, scenario, told, with_page, with_served, with_server } from "./page.mjs";
import { html, sections, view_file } from "./run_file.mjs";

const text = (page, id) => page.evaluate(name => document.getElementById(name).textContent, id);

test("view page: a vehicle has the state that the command where prints, and is drawn only while it is present", () => with_page("fcd", {}, async page => {
    for (const t of [0, 2, 5, 7, 10, 12, 18]) {
        for (const [i, { presence }] of told("where", scenario("fcd"), "--at", `${t}s`, "--json").times[0].robots.entries()) {
            await page.evaluate(([at, robot]) => window.rovernet.select({ t: at, robots: [robot], panel: "robot" }), [t * 1e9, i]);
            await drawn(page);
            const state = await page.evaluate(() => [...document.querySelectorAll("#robot-place dt")].find(name => name.textContent === "state").nextElementSibling.textContent);
            assert.equal(state, presence.replace("_", " "), `robot ${i} at ${t} s`);
            const found = await page.evaluate(robot => {
                const { robots, sides } = window.rovernet.parts, [x, y] = pixel(robot);
                return robots.near(sides.own.all[0].run, x, y, 0);
            }, i);
            assert.equal(found, presence === "on" ? i : -1, `robot ${i} at ${t} s`);
        }
    }
}));

test("view page, part of a run: a page with --from and --to says that its panels count only this part", async () => {
    const file = path.join(folder, "part.html");
    printed("view", path.join(folder, "rescue"), "-o", file, "--from", "20 s", "--to", "30 s");
    await with_page("part", {}, async page => {
        await page.evaluate(() => window.rovernet.select({ robots: [1], panel: "robot" }));
        await page.waitForFunction(() => document.getElementById("robot-panel").textContent.includes("sent"));
        assert.match(await text(page, "robot-panel"), /In the part that is shown/);
        await page.evaluate(() => window.rovernet.select({ message: 0, panel: "message" }));
        await page.waitForFunction(() => document.getElementById("message-panel").textContent.includes("got it"));
        assert.match(await text(page, "message-panel"), /after 0 frames\. Left out: \d+ frames of it\./);
        assert.doesNotMatch(await text(page, "message-panel"), /reached this robot\./);
    });
    await with_page("rescue", {}, async page => {
        await page.evaluate(() => window.rovernet.select({ robots: [1], panel: "robot" }));
        assert.match(await page.waitForFunction(() => document.getElementById("robot-panel").textContent).then(found => found.jsonValue()), /In the whole run/);
    });
});

test("view page, metrics of a run: whole numbers are shown with all digits, other numbers with seven", () => with_page("many", {}, async page => {
    const { metrics } = sections(view_file("many")).head;
    await page.evaluate(() => window.rovernet.select({ panel: "charts" }));
    const shown = await page.evaluate(() => [...document.querySelectorAll("#charts-panel .facts dd")].map(one => Number(one.textContent.replace("\u2212", "-"))));
    const values = Object.values(metrics).filter(value => typeof value === "number");
    assert.ok(values.some(value => Number.isInteger(value) && value > 1e5));
    assert.equal(shown.length, values.length);
    values.forEach((value, i) => assert.ok(Number.isInteger(value) ? shown[i] === value : Math.abs(shown[i] - value) <= 1e-6 * Math.abs(value), `${value}, ${shown[i]}`));
}));

test("view page, messages of a robot: at the start of a data block, the panel still shows messages of the previous block", () => with_page("many", {}, async page => {
    const { blocks } = sections(view_file("many")).head;
    assert.ok(blocks.length > 1);
    await page.evaluate(t => window.rovernet.select({ t, robots: [0], panel: "robot" }), blocks[1].begin_ns);
    await page.waitForFunction(() => window.rovernet.list() !== null);  // the events of the second block are there
    await drawn(page);
    await page.waitForFunction(() => document.querySelectorAll("#robot-messages button").length >= 10);
}));

test("view page, address: a map view or time span that no window can show is left out, and a time is rounded to a nanosecond", async () => {
    for (const hash of ["#view=24,12,1e30", "#view=1e300,0,1", "#view=0,0,1e-300", "#span=100000000,100000000.000000016", "#span=1,1.000000002", "#t=1e300"]) {
        await with_page("rescue", { hash }, async page => {
            await page.evaluate(() => window.rovernet.select({ trails: false }));
            await drawn(page);
            assert.deepEqual(await page.evaluate(() => [window.rovernet.state.view, window.rovernet.state.span]), [null, null]);
        });
    }
    await with_page("rescue", {}, async page => {
        await page.evaluate(() => window.rovernet.select({ t: 9999999999.7, view: { x: 5400012.4321, y: 1, scale: 900 } }));
        await page.waitForFunction(() => location.hash.includes("view="));
        assert.match(await page.evaluate(() => location.hash), /t=10&view=5400012.4321,1,900/);
    });
});

test("view page, address: the browser's Back and Forward go through the selections, each once, and keep the time", () => with_page("csma", {}, async page => {
    const shown = () => page.evaluate(() => `${window.rovernet.state.robots} ${window.rovernet.t / 1e9}`);
    const rest = () => page.waitForTimeout(500);  // until the address is that of the time
    for (const [t, robot] of [[1, 0], [5, 1], [7, 1], [9, -1]]) {
        await page.evaluate(ns => window.rovernet.seek(ns), t * 1e9);
        await rest();
        if (robot >= 0) await page.evaluate(i => window.rovernet.select({ robots: [i] }), robot);
        await rest();
    }
    const entries = await page.evaluate(() => history.length);
    for (const [go, wanted] of [["goBack", "0 9"], ["goBack", " 9"], ["goForward", "0 9"], ["goForward", "1 9"], ["goBack", "0 9"], ["goBack", " 9"]]) {
        await page[go]();
        await rest();
        assert.equal(await shown(), wanted);
        assert.equal(await page.evaluate(() => history.length), entries);
    }
}));

test("view page, address: the browser's Back keeps the time, speed and view of a page that has played since it was opened", () => with_page("csma", {}, async page => {
    await page.evaluate(() => window.rovernet.select({ speed: 0.5, trails: false }));
    await page.keyboard.press(" ");
    await page.waitForFunction(() => window.rovernet.t > 2e8);
    await page.evaluate(() => window.rovernet.select({ robots: [0] }));
    await page.goBack();
    await page.waitForFunction(() => window.rovernet.state.robots.length === 0);
    const { t, speed, trails, playing } = await page.evaluate(() => structuredClone(window.rovernet.state));
    assert.ok(t > 2e8, `${t} ns`);
    assert.deepEqual({ speed, trails, playing }, { speed: 0.5, trails: false, playing: true });
}));

test("view page, events: a saved table ends after the largest allowed number of rows, and the page says where it ends", () => with_page("csma", {}, async page => {
    await page.evaluate(() => window.rovernet.parts.files.most_rows = 1000);
    const saved = page.waitForEvent("download");
    await page.click("#table");
    const lines = fs.readFileSync(await (await saved).path(), "utf8").trimEnd().split("\n");
    assert.equal(lines.length, 1001);
    assert.match(await text(page, "status"), /The table ends after/);
}));

test("view page: labels of long names with a common beginning differ; a page that contains no run does not say that it reads a run", async () => {
    const bytes = view_file("rescue"), length = bytes.readUInt32LE(4);
    let head = bytes.subarray(8, 8 + length).toString();
    for (const name of ["A", "B"]) head = head.replace(`"name":"${name}"`, `"name":"robot with a very long name, number ${name}"`);
    const named = Buffer.from(head), begin = Buffer.from("RVW1\0\0\0\0");
    begin.writeUInt32LE(named.length, 4);
    const data = Buffer.concat([begin, named, bytes.subarray(8 + length)]), page_of = run => html("rescue").replace(/(id="run"[^>]*>)[^<]*/, `$1${run}`);
    fs.writeFileSync(path.join(folder, "named.html"), page_of(data.toString("base64")));
    await with_page("named", {}, async page => {
        const labels = await page.evaluate(() => [0, 1].map(i => window.rovernet.parts.sides.own.all[0].run.label(i)));
        assert.notEqual(labels[0], labels[1]);
        for (const label of labels) assert.equal([...label].length, 24);
    });
    fs.writeFileSync(path.join(folder, "none.html"), page_of(""));
    await with_page("none", { error: /no run/ }, async page => assert.equal(await text(page, "caption"), ""));
});

test("view page, link budget: each wall of a link between storeys is marked only on the map of the wall's storey", () => with_server(path.join(folder, "storeys"), address => with_served(address, { hash: "#t=13" }, async page => {
    const walls = await page.evaluate(async () => {
        const { server } = window.rovernet.parts, robots = window.rovernet.parts.sides.own.all[0].run.robots;
        window.marks = 0;
        const { stroke } = CanvasRenderingContext2D.prototype;
        CanvasRenderingContext2D.prototype.stroke = function (...path) {
            if (this.lineWidth === 7) window.marks++;
            stroke.apply(this, path);
        };
        let best = { a: 0, b: 1, t: 0, walls: 0 };
        for (let t = 0; t < 40e9; t += 2e9) for (let a = 0; a < robots; a++) for (let b = 0; b < a; b++) {
            const { links: [link] } = await server.ask("pair", { a, b, t_ns: t }).catch(() => ({ links: [{ walls: [] }] }));
            const storeys = [a, b].map(i => { const { run } = window.rovernet.parts.sides.own.all[0]; return run.storey(run.pose(i, t).z); });
            if (storeys[0] !== storeys[1] && link.walls.length > best.walls) best = { a, b, t, walls: link.walls.length };
        }
        window.rovernet.select({ t: best.t, robots: [best.a, best.b], panel: "pair" });
        return best.walls;
    });
    assert.ok(walls > 0);
    await page.getByRole("button", { name: "budget at this time" }).click();
    await page.waitForFunction(() => document.querySelector("#pair-answer table"));
    let marked = 0;
    const storeys = await page.evaluate(() => window.rovernet.parts.sides.own.all[0].run.head.map.floors.length);
    for (let storey = 0; storey < storeys; storey++) {
        await page.evaluate(i => window.rovernet.select({ storey: i }), storey);
        await drawn(page);
        await page.evaluate(() => { window.marks = 0; window.rovernet.select({ trails: !window.rovernet.state.trails }); });
        await drawn(page);
        marked += await page.evaluate(() => window.marks);
    }
    assert.equal(marked, walls);
})));

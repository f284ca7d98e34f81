// SPDX-License-Identifier: MIT
// A run that goes on, in a browser: the page shows its present, paces it, and keeps what it has when it ends.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { drawn, folder, printed, scenario, told, with_command, with_page, with_served } from "./page.mjs";
import { sections, view_file } from "./run_file.mjs";

let number = 0;
/** Command that runs a scenario with a page. */
function run(name, ...words) { return ["run", name, "--view", "--out", path.join(folder, `live${++number}`), ...words]; }
const state = page => page.evaluate(() => rovernet.parts.live.state());
/** Waits until the state of the run passes. */
function until(page, passes, argument) { return page.waitForFunction(passes, argument); }
const exact = text => Number(text.replace(/\s/g, ""));

test("live view page: a page pauses and steps a run, sets the speed of the run, and shows its past and its present", () =>
    with_command(run(scenario("rescue")), address => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 5e8);
        assert.equal(await page.textContent("#present"), "live");
        await page.click("#play");
        await until(page, () => rovernet.parts.live.state().paused);
        await until(page, () => document.getElementById("present").textContent === "run paused");
        const paused = await state(page);
        await drawn(page);
        assert.equal(await page.evaluate(() => rovernet.t), paused.now_ns);
        await page.keyboard.press("ArrowRight");
        await until(page, before => rovernet.parts.live.state().now_ns > before, paused.now_ns);
        assert.equal((await state(page)).now_ns - paused.now_ns, 1e8);
        const there = told("where", scenario("rescue"), "--at", `${(await state(page)).now_ns / 1e9}s`, "--json").times[0].robots;
        await drawn(page);
        for (const [i, robot] of there.entries()) {
            const seen = await page.evaluate(index => rovernet.position(index), i);
            assert.ok(Math.hypot(seen.x - robot.x_m, seen.y - robot.y_m) < 1e-3, robot.name);
        }
        await page.keyboard.press(" ");
        await page.evaluate(() => rovernet.parts.clock.set_power(2));
        await until(page, () => rovernet.parts.live.state().speed === 100 && rovernet.parts.live.state().now_ns > 12e9);
        assert.equal(await page.evaluate(() => { rovernet.parts.clock.seek(0); return rovernet.parts.live.text(); }), "to the present");
        await page.click("#present");
        await until(page, () => rovernet.parts.live.state().ended);
        assert.equal(await page.textContent("#present"), "run ended");
        assert.equal(await page.evaluate(() => rovernet.t), 90e9);
    })));

for (const name of ["rescue", "csma", "storeys"]) {
    test(`live view page: the run ${name} has the same fingerprint with and without a page, and the page counts all copies`, () =>
        with_command(run(scenario(name), "--speed", "200"), address => with_served(address, {}, async page => {
            await until(page, () => rovernet.parts.live.state().ended);
            const { fingerprint, receptions } = told("run", scenario(name), "--json", "--out", path.join(folder, `plain${++number}`));
            assert.equal((await state(page)).fingerprint, fingerprint);
            await drawn(page);
            const counts = await page.evaluate(() => ({ all: document.getElementById("caption").textContent, shown: window.rovernet.density().reduce((a, column) => a + column.reduce((x, y) => x + y, 0), 0) }));
            const told_count = exact(/([\d\s]+) copies/.exec(counts.all)[1]);
            assert.equal(counts.shown, told_count);
            assert.ok(told_count >= receptions);
        })));
}

test("live view page: Ctrl-C ends the run within 3 s with its results, and the page keeps what it has received", () =>
    with_command(run(scenario("rescue"), "--speed", "10"), (address, server, ended) => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 11e9);
        const begin = Date.now();
        server.kill("SIGINT");
        assert.equal(await ended, 0);
        assert.ok(Date.now() - begin < 3000);
        await until(page, () => rovernet.parts.live.state().ended);
        assert.equal(await page.textContent("#present"), "run ended");
        assert.ok(await page.evaluate(() => rovernet.t) > 11e9);
        assert.ok(fs.existsSync(path.join(folder, `live${number}`, "summary.json")));
    })));

test("live view page: a reloaded page, and a page that is opened late, show the whole run", () =>
    with_command(run(scenario("rescue"), "--speed", "50"), address => with_served(address, {}, async (page, context) => {
        await until(page, () => rovernet.parts.live.state().now_ns > 30e9);
        await page.reload();
        const late = await context.newPage();
        await late.goto(address);
        for (const each of [page, late]) await until(each, () => window.rovernet?.ready && rovernet.parts.live.state().ended);
        // The end is known before it is drawn: two frames later it is.
        for (const each of [page, late]) await each.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
        const texts = await Promise.all([page, late].map(each => each.textContent("#caption")));
        assert.equal(texts[0], texts[1]);
        const { messages } = told("run", scenario("rescue"), "--json", "--out", path.join(folder, `plain${++number}`));
        assert.ok(texts[0].includes(`${messages} messages`), texts[0]);
    })));

test("live --view-control: a page moves a robot and sends a message, and its commands are logged as inputs", () => {
    const out = path.join(folder, `live${++number}`);
    return with_command(["live", scenario("rescue"), "--view", "--view-control", "--out", out], (address, server, ended) => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 3e8);
        await page.evaluate(() => rovernet.select({ robots: [0], panel: "robot" }));
        await page.fill("[aria-label^='goal of the robot']", "20, 12");
        await page.getByRole("button", { name: "go", exact: true }).click();
        await page.fill("[aria-label^='message to']", "from the page");
        await page.getByRole("button", { name: "send", exact: true }).click();
        await until(page, () => document.getElementById("caption").textContent.includes("1 message"));
        await until(page, () => Math.hypot(rovernet.position(0).vx, rovernet.position(0).vy) > 0.5);
        server.kill("SIGINT");
        await ended;
        const inputs = fs.readFileSync(path.join(out, "inputs.jsonl"), "utf8");
        assert.match(inputs, /"goal":\[20\.0,12\.0/);
        assert.match(inputs, /viewer/);
    }));
});

test("live --view-control: the goal of a robot is on the storey on whose map the page was clicked", () => {
    const out = path.join(folder, `live${++number}`);
    return with_command(["live", scenario("storeys"), "--view", "--view-control", "--out", out], (address, server, ended) => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 3e8);
        await page.evaluate(() => rovernet.select({ robots: [0], panel: "robot", storey: 1 }));
        await page.getByRole("button", { name: "drive to the place" }).click();
        const { x, y } = await page.locator("#map").boundingBox(), [px, py] = await page.evaluate(() => [rovernet.parts.camera.to_x(10), rovernet.parts.camera.to_y(8.5)]);
        await page.mouse.click(x + px, y + py);
        await until(page, () => document.getElementById("robot-place").textContent.includes("found no way"));  // walls are between
        server.kill("SIGINT");
        await ended;
        const [, goal] = /"goal":\[([^\]]*)\]/.exec(fs.readFileSync(path.join(out, "inputs.jsonl"), "utf8"));
        const [at_x, at_y, at_z] = goal.split(",").map(Number);
        assert.ok(Math.hypot(at_x - 10, at_y - 8.5) < 0.1 && at_z === 3, goal);
    }));
});

test("live --view: without --view-control a page cannot pause the run", () =>
    with_command(["live", scenario("rescue"), "--view", "--out", path.join(folder, `live${++number}`)], address => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 3e8);
        assert.equal((await state(page)).controls_time, false);
        const told_page = await page.evaluate(() => rovernet.parts.server.ask("pace", { paused: true }).then(() => "", error => error.message));
        assert.match(told_page, /--view-control/);
        await page.click("#play");
        const { now_ns } = await state(page);
        await until(page, before => rovernet.parts.live.state().now_ns > before + 3e8, now_ns);
        assert.equal(await page.textContent("#present"), "to the present");
    })));

test("live view page: a page whose server was killed shows the run of the next server on the same port", () =>
    with_command(run(scenario("rescue")), (address, server, ended) => with_served(address, { faults: /ERR_CONNECTION_(REFUSED|RESET)/ }, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 2e8);
        server.kill("SIGKILL");
        await ended;
        await until(page, () => document.getElementById("present").textContent === "server gone");
        const port = new URL(address).port;
        await with_command(["run", scenario("csma"), "--view", `127.0.0.1:${port}`, "--out", path.join(folder, `live${++number}`)], async () => {
            await until(page, () => window.rovernet?.ready && document.getElementById("name").textContent === "csma" && rovernet.parts.live.state().now_ns > 2e8);
        });
    })));

test("run --view: the reason for a missed message, and the charts, equal those of the recorded trace", () => {
    const out = path.join(folder, `live${++number}`), missed = sections(view_file("rescue")).head.follow[0].message;
    return with_command(["run", scenario("rescue"), "--view", "--record", "--speed", "5", "--out", out], address => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 11e9);
        await page.click("#play");
        await until(page, () => rovernet.parts.live.state().paused);
        await page.evaluate(message => rovernet.select({ message, panel: "message" }), missed);
        const rows = page.locator("#message-panel ul.plain > li:not(.wide)"), name = await rows.filter({ hasText: "why?" }).first().locator("button.link").textContent();
        const row = rows.filter({ has: page.getByRole("button", { name, exact: true }) });
        await row.getByText("why?").click();
        await row.getByText("why?").waitFor({ state: "detached" });
        const text = await row.locator("span span").first().textContent();
        await page.click("#play");
        await page.evaluate(() => rovernet.parts.clock.set_power(2));
        await page.evaluate(() => rovernet.select({ panel: "charts" }));
        await until(page, () => rovernet.parts.live.state().ended && rovernet.charts(0).length > 0);
        // What was told stays, though the run has gone on.
        assert.ok((await page.textContent("#message-panel")).includes(text));
        await page.waitForFunction(() => document.getElementById("charts-panel").textContent.includes("Metrics of the run"));
        const { answer } = told("trace", "follow", path.join(out, "trace.mcap"), "--message", String(missed), "--robot", name, "--json").at_robot;
        assert.equal(`${name} ${text}`, answer);
        const times = [12e9, 30e9, 75e9], charts = await page.evaluate(all => all.map(t => rovernet.charts(t)), times);
        printed("view", out, "-o", `${out}.html`);
        await with_page(`${out}.html`, {}, async recorded => {
            assert.deepEqual(await recorded.evaluate(all => all.map(t => rovernet.charts(t)), times), charts);
        });
        assert.ok(charts[2].length >= 4);
    }));
});

test("run --view: a page that is reloaded during the run selects the message in its address again", () =>
    with_command(run(scenario("rescue"), "--speed", "20"), address => with_served(address, {}, async page => {
        await until(page, () => rovernet.parts.live.state().now_ns > 15e9);
        await page.evaluate(() => rovernet.select({ message: 1 }));
        await until(page, () => location.hash.includes("message=1"));
        await page.reload();
        await until(page, () => window.rovernet?.ready && rovernet.parts.live.state().now_ns > 16e9);
        await until(page, () => rovernet.state.message === 1);
        assert.match(page.url(), /message=1/);
    })));

// SPDX-License-Identifier: MIT
// The air at a robot, and its antenna: against the frames of the run and against rovernet link.
import assert from "node:assert/strict";
import path from "node:path";
import test from "node:test";
import { drawn, folder, told, scenario, with_page, with_served, with_server } from "./page.mjs";
import { reader, view_file } from "./run_file.mjs";

/** Frames of a run: start, end [ns], sender, and who could hear it. */
async function frames(name) {
    const { rvw, run, blocks } = reader(), r = await run.load(rvw.open(new Uint8Array(view_file(name)))), all = new blocks.Blocks(r), out = [];
    for (let i = 0; i < all.info.length; i++) {
        const block = await all.load(i);
        for (let f = 0; f < block.flights; f++) {
            out.push({ start: block.start[f], end: block.end(f), sender: block.sender[f], heard: new Set(block.robot.subarray(block.first[f], block.first[f + 1])) });
        }
    }
    return out;
}

/** Length of the union of intervals. */
function union(spans) {
    let length = 0, until = -Infinity;
    for (const [from, to] of spans.sort((a, b) => a[0] - b[0])) {
        length += Math.max(0, to - Math.max(from, until));
        until = Math.max(until, to);
    }
    return length;
}

test("view page, air at a robot: the busy time of the last second is the time covered by frames that the robot sent or heard", () => with_server(path.join(folder, "many"), address => with_served(address, {}, async page => {
    const all = await frames("many"), at = 3e9, from = at - 1e9;
    for (const robot of [7, 500]) {
        await page.evaluate(([i, t]) => window.rovernet.select({ t, robots: [i], panel: "robot" }), [robot, at]);
        await page.getByRole("button", { name: "ask for air" }).click();
        await page.waitForFunction(() => document.querySelector("#robot-air dl"));
        const facts = await page.$eval("#robot-air dl", one => Object.fromEntries([...one.querySelectorAll("dt")].map(name => [name.textContent, name.nextElementSibling.textContent])));
        const own = all.filter(f => f.sender === robot && f.start < at && f.end > from), others = all.filter(f => f.heard.has(robot) && f.start < at && f.end > from);
        const share = spans => 100 * union(spans.map(f => [Math.max(f.start, from), Math.min(f.end, at)])) / 1e9;
        // A frame comes some ns later than it was sent.
        assert.ok(Math.abs(parseFloat(facts.busy) - share([...own, ...others])) < 0.02 * share([...own, ...others]) + 0.01, `${facts.busy}, not ${share([...own, ...others])}`);
        assert.ok(Math.abs(parseFloat(facts["its own"]) - share(own)) < 0.01, facts["its own"]);
        assert.match(facts["its own"], new RegExp(`${own.length} frames?$`));
        assert.ok(facts["of others"].startsWith(`${others.length} frame`), `${facts["of others"]}, not ${others.length}`);
        assert.ok(others.length > 50);
    }
})));

test("view page, antenna: the pattern of a selected robot has the gains that the command link prints for the same directions", () => with_page("antennas", {}, async page => {
    const file = scenario("antennas"), seen = new Set();
    const pattern = await page.evaluate(() => rovernet.parts.antennas.gains(rovernet.parts.sides.own.all[0].run, 0));
    assert.equal(pattern.length, 72);
    for (const [other, x, y] of [["plain", -40, 30], ["behind", 20, -40]]) {
        const link = told("link", file, "beam", other, "--json"), angle = Math.atan2(y, x) - 30 * Math.PI / 180, at = (angle / (2 * Math.PI) * 72 + 72) % 72;
        const low = pattern[Math.floor(at)], high = pattern[(Math.floor(at) + 1) % 72], truth = link.sender_pattern_db;
        assert.ok(truth >= Math.min(low, high) - 1e-9 && truth <= Math.max(low, high) + 1e-9, `${other} ${truth}: ${low} to ${high}`);
        seen.add(truth);
    }
    assert.equal(seen.size, 2);
    assert.equal(await page.evaluate(() => rovernet.parts.antennas.gains(rovernet.parts.sides.own.all[0].run, 1)), null);
    // It is drawn where the gain is: to the left of the heading, and not behind.
    const [ahead, behind] = await page.evaluate(async () => {
        const canvas = document.getElementById("map"), ratio = canvas.width / canvas.clientWidth, copy = document.createElement("canvas");
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const c = copy.getContext("2d", { willReadFrequently: true }), frame = () => new Promise(done => requestAnimationFrame(done));
        const look = () => {
            c.clearRect(0, 0, copy.width, copy.height);
            c.drawImage(canvas, 0, 0);
            return [120, 300].map(degrees => {
                const [x, y] = pixel(0), angle = degrees * Math.PI / 180;
                return c.getImageData(Math.round((x + 40 * Math.cos(angle)) * ratio), Math.round((y - 40 * Math.sin(angle)) * ratio), 1, 1).data.join();
            });
        }, before = look();
        window.rovernet.select({ robots: [0] });
        await frame();
        await frame();
        return look().map((color, i) => color !== before[i]);
    });
    assert.deepEqual([ahead, behind], [true, false]);
    await drawn(page);
    assert.match(await page.textContent("#legend"), /antenna: gain by direction/);
}));

// SPDX-License-Identifier: MIT
// The queue of a robot in its inspector: against the lines of rovernet trace convert.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { folder, printed, trace, with_page } from "./page.mjs";

/** Frames of each robot with its queue then: messages that it made less those that it sent and those that found no room. */
function sent_frames(name) {
    const file = path.join(folder, `${name}.csv`), waiting = new Map(), out = [];
    printed("trace", "convert", trace(name), file, "--to", "csv", "--mac");
    for (const line of fs.readFileSync(file, "utf8").split("\n")) {
        const [event, time_s, robot, layer, reason] = line.split(",");
        const queue = waiting.get(robot) ?? 0;
        if (event === "s" && layer === "AGT") waiting.set(robot, queue + 1);
        if (event === "D" && reason === "IFQ") waiting.set(robot, queue - 1);
        if (event !== "s" || layer !== "MAC") continue;
        out.push({ time_s, robot: Number(robot), queue });
        waiting.set(robot, queue - 1);
    }
    return out;
}

/** The row "queue" of a robot's inspector. */
async function queue_of(page, robot, t) {
    await page.evaluate(([i, at]) => window.rovernet.select({ t: at, robots: [i], panel: "robot" }), [robot, t]);
    return page.evaluate(async () => {
        await new Promise(done => requestAnimationFrame(done));
        const name = [...document.querySelectorAll("#robot-place dt")].find(one => one.textContent === "queue");
        return name?.nextElementSibling.textContent.replaceAll("\u202f", "") ?? "";
    });
}

test("view page, queue: the length of a robot's queue is the number of messages made, minus those sent and those dropped by the full queue", () => with_page("queue", {}, async page => {
    const frames = sent_frames("queue"), longest = Math.max(...frames.map(frame => frame.queue));
    assert.equal(longest, 20);  // it was full
    for (const { time_s, robot, queue } of frames) {
        const at = Math.round(Number(time_s) * 1e9);
        assert.equal(await queue_of(page, robot, at + 1), `${queue} ${queue === 1 ? "frame" : "frames"}, as it sent at ${time_s.slice(0, -3)} s`);
    }
    assert.equal(await queue_of(page, 2, 1e9), "");  // it never sent
}));

test("view page, queue: the panel of a robot that sends without waiting shows no queue", () => with_page("rescue", {}, async page => {
    assert.equal(await queue_of(page, 0, 10.5e9), "");
}));

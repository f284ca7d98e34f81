// SPDX-License-Identifier: MIT
// Several pages of one run: one that does not read holds up neither the run nor the others, and catches up.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { folder, launched, scenario, with_command, with_served } from "./page.mjs";
import { html } from "./run_file.mjs";

const state = page => page.evaluate(() => rovernet.parts.live.state());
/** Resident memory of a process [bytes]. */
const memory = pid => 1024 * Number(/VmRSS:\s+(\d+)/.exec(fs.readFileSync(`/proc/${pid}/status`, "utf8"))[1]);
/** Simulated time [ns] that a page must see pass while another one does not read. */
const passing = 3e9;
/** Memory that a page which does not read may take: what waits for it, and what the system's allocator keeps [bytes]. */
const spare = 8e6;
/** How to wait for a page whose process was stopped: its browser draws no frame by itself for a while. */
const polled = { timeout: 60000, polling: 100 };

test("live view page: a page that does not read for a while takes little memory, delays no other page, and catches up later", async () => {
    const out = path.join(folder, "slow");
    await with_command(["live", path.join(folder, "many.toml"), "--view", "--set", "scenario.duration=600 s", "--out", out], (address, server, ended) => with_served(address, {}, async page => {
        let got = 0;
        const frames = await page.context().newCDPSession(page);
        await frames.send("Network.enable");
        frames.on("Network.webSocketFrameReceived", ({ response }) => got += 0.75 * response.payloadData.length);
        const browser = await launched();
        try {
            const slow = await browser.newPage();
            await slow.goto(address);
            await slow.waitForFunction(() => window.rovernet?.ready && rovernet.parts.live.state().now_ns > 1e9);
            const { processInfo } = await (await browser.newBrowserCDPSession()).send("SystemInfo.getProcessInfo");
            const renderers = processInfo.filter(process => process.type === "renderer").map(process => process.id);
            assert.ok(renderers.length > 0);
            for (const pid of renderers) process.kill(pid, "SIGSTOP");
            try {
                const before = await state(page), bytes = memory(server.pid), got_before = got;
                await page.waitForFunction(([t, more]) => rovernet.parts.live.state().now_ns > t + more, [before.now_ns, passing], { timeout: 60000 });
                const grown = memory(server.pid) - bytes, sent = got - got_before;
                // The server keeps what it has sent, for pages that come later.
                assert.ok(sent > 1e5, `${sent} bytes were sent`);
                assert.ok(grown < 2 * sent + spare, `${grown} bytes more, for ${sent} that were sent`);
            } finally {
                for (const pid of renderers) process.kill(pid, "SIGCONT");
            }
            const { now_ns } = await state(page);
            await slow.waitForFunction(t => rovernet.parts.live.state().now_ns >= t && rovernet.parts.live.text() !== "server gone", now_ns, polled);
            server.kill("SIGINT");
            assert.equal(await ended, 0);
            const captions = [];
            for (const each of [page, slow]) {
                await each.waitForFunction(() => rovernet.parts.live.state().ended, undefined, polled);
                captions.push(await each.textContent("#caption"));
            }
            assert.equal(captions[1], captions[0]);
        } finally {
            await browser.close();
        }
    }));
});

test("live view page: ten pages of one run show the same counts and positions at the end of the run", () =>
    with_command(["run", scenario("rescue"), "--view", "--speed", "30", "--out", path.join(folder, "ten")], address => with_served(address, {}, async (page, context) => {
        const pages = [page];
        while (pages.length < 10) {
            const more = await context.newPage();
            await more.setViewportSize({ width: 480, height: 360 });  // ten large maps keep a processor without a graphics card busy
            await more.goto(address);
            pages.push(more);
        }
        const seen = [];
        for (const each of pages) {
            await each.waitForFunction(() => window.rovernet?.ready && rovernet.parts.live.state().ended, undefined, { timeout: 60000 });
            // The end is known before it is drawn: two frames later it is.
            await each.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
            seen.push(await each.evaluate(() => JSON.stringify([document.getElementById("caption").textContent, [0, 1, 2, 3, 4].map(i => rovernet.position(i))])));
        }
        assert.equal(new Set(seen).size, 1);
    })));

test("view page: a page whose file is cut off before the script says that the file is cut off", async () => {
    const cut = path.join(folder, "cut.html"), whole = html("rescue");
    fs.writeFileSync(cut, whole.slice(0, whole.indexOf('id="run"') + 1000));
    const browser = await launched();
    try {
        const page = await browser.newPage();
        await page.goto(`file://${cut}`);
        assert.match(await page.textContent("#caption"), /the file is cut off/);
    } finally {
        await browser.close();
    }
});

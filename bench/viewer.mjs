// SPDX-License-Identifier: MIT
// Measures for bench/viewer. CPU times of the page's script are those of its thread, so that a busy machine changes them little.
import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import net from "node:net";
import os from "node:os";
import zlib from "node:zlib";
import { chromium } from "playwright-core";

const { COMMAND: command, CHROMIUM: browser_path, FOLDER: folder, RESCUE: rescue } = process.env;
const ticks = Number(execFileSync("getconf", ["CLK_TCK"], { encoding: "utf8" }));

function row(what, budget, measured) { console.log(`| ${what} | ${budget} | ${measured} |`); }
const median = values => [...values].sort((a, b) => a - b)[values.length >> 1];
const passed = ms => new Promise(done => setTimeout(done, ms));

/** CPU time of a process and its descendants [ms]. */
function cpu_of(root) {
    const parents = new Map(), times = new Map();
    for (const name of fs.readdirSync("/proc").filter(file => /^\d+$/.test(file))) {
        try {
            const fields = fs.readFileSync(`/proc/${name}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
            parents.set(Number(name), Number(fields[1]));
            times.set(Number(name), (Number(fields[11]) + Number(fields[12])) * 1000 / ticks);
        } catch {
            // It ended meanwhile.
        }
    }
    const is_of_root = pid => pid === root || pid > 1 && is_of_root(parents.get(pid) ?? 0);
    return [...times].filter(([pid]) => is_of_root(pid)).reduce((sum, [, time]) => sum + time, 0);
}

/** A page in a browser of its own, ready: act(page, script_ms, all_ms). The last two return CPU times until now. */
async function with_page(url, act) {
    const server = await chromium.launchServer({ executablePath: browser_path, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
    const browser = await chromium.connect(server.wsEndpoint());
    try {
        const page = await browser.newPage({ viewport: { width: 1280, height: 720 } }), begin = performance.now();
        await page.goto(url);
        await page.waitForFunction(() => window.rovernet?.ready && window.rovernet.frames > 0);
        const opened = performance.now() - begin, cdp = await page.context().newCDPSession(page);
        await cdp.send("Performance.enable", { timeDomain: "threadTicks" });
        const script = async () => 1e3 * (await cdp.send("Performance.getMetrics")).metrics.find(m => m.name === "ScriptDuration").value;
        await act({ page, cdp, opened, script, all: () => cpu_of(server.process().pid) });
    } finally {
        await browser.close();
        await server.close();
    }
}

/** CPU time of the command [s]. */
function cpu_of_command(...words) {
    const text = execFileSync("bash", ["-c", 'TIMEFORMAT="%U %S"; { time "$@" > /dev/null 2>&1; } 2>&1', "bash", command, ...words], { encoding: "utf8" });
    return text.trim().split(" ").reduce((sum, part) => sum + Number(part), 0);
}

/** Serves a run or a scenario: act(address, CPU time until then [s]). */
async function served(file, act) {
    const server = spawn(command, ["view", file], { stdio: ["ignore", "pipe", "ignore"] }), ended = new Promise(done => server.on("exit", done));
    const address = await new Promise(done => server.stdout.on("data", text => done(/http:\S+/.exec(String(text))[0])));
    try {
        await act(address, cpu_of(server.pid) / 1e3);
    } finally {
        server.kill("SIGINT");
        await ended;
    }
}

/** Seeks and waits until all is drawn. */
function seek(page, t) {
    return page.evaluate(async at => {
        const { frames } = window.rovernet, frame = () => new Promise(done => requestAnimationFrame(done));
        window.rovernet.seek(at);
        while (window.rovernet.frames === frames || !window.rovernet.whole || !window.rovernet.list()) await frame();
    }, t);
}

async function frames_of_a_swarm({ page, script, all }) {
    for (const t of [0.3e9, 2e9, 0.3e9]) await seek(page, t);
    await page.keyboard.press("k");
    await passed(1000);  // the browser compiles the script
    const of = () => page.evaluate(() => window.rovernet.frames);
    const [frames, begin, begin_all] = [await of(), await script(), all()];
    await passed(3000);
    const [drawn, end, end_all] = [await of() - frames, await script(), all()];
    row("script time for each frame, with 10,000 robots and 55,000 receptions/s", "4 ms", `${((end - begin) / drawn).toFixed(1)} ms`);
    row("time of the whole browser for each frame, in the same run", "60 ms", `${((end_all - begin_all) / drawn).toFixed(0)} ms`);
}

async function large_run({ page, cdp, opened, script, all }) {
    const size = fs.statSync(`${folder}/large.html`).size;
    row("opening the page of the large run (elapsed time)", "4 s", `${(opened / 1e3).toFixed(1)} s`);
    row("size of the page of the large run", "12 MB", `${(size / 1e6).toFixed(1)} MB`);
    const seeks = 200, taken = [];
    for (let i = 0; i < 5; i++) await seek(page, 1e9 + i * 1e7);
    const begin = await script();
    for (let i = 1; i <= seeks; i++) await seek(page, (1 + i * 0.618034 % 1) * 1e9);
    row("script time of a jump to another time, mean of 200", "10 ms", `${((await script() - begin) / seeks).toFixed(1)} ms`);
    for (let i = 1; i <= 20; i++) {
        const before = await script();
        await seek(page, (i * 0.618034 % 1) * 60e9);
        taken.push(await script() - before);
    }
    row("script time of a jump that unpacks blocks of data, median of 20", "60 ms", `${median(taken).toFixed(0)} ms`);
    await cdp.send("HeapProfiler.collectGarbage");
    const { usedSize, backingStorageSize } = await cdp.send("Runtime.getHeapUsage");
    row("memory of the script of this page, including the data of the run", "150 MB", `${((usedSize + backingStorageSize) / 1e6).toFixed(0)} MB`);
    const frames = await page.evaluate(() => window.rovernet.frames), stopped = await share_of_10_s(all);
    row("frames that the page draws in 13 s while the playback is stopped", "0", `${await page.evaluate(() => window.rovernet.frames) - frames}`);
    row("processor share of the whole browser while the playback is stopped", "1 %", stopped);
    await page.goto("about:blank");
    row("processor share of the whole browser with an empty page", "", await share_of_10_s(all));
}

/** Share of a processor that a browser takes in 10 s, after 3 s for what it finishes. */
async function share_of_10_s(all) {
    await passed(3000);
    const rest = all();
    await passed(10000);
    return `${((all() - rest) / 100).toFixed(1)} %`;
}

/** Median time of an answer [ms], on the wall. */
function answered(page, question) {
    return page.evaluate(async asked => {
        const socket = new WebSocket(location.href.replace("http", "ws").split("#")[0]), taken = [];
        await new Promise(done => socket.onopen = done);
        for (let id = 0; id < 7; id++) {
            const begin = performance.now(), answer = new Promise(done => socket.onmessage = event => done(JSON.parse(event.data)));
            socket.send(JSON.stringify({ id, ...asked }));
            const { error } = await answer;
            if (error) throw new Error(error);
            taken.push(performance.now() - begin);
        }
        socket.close();
        return taken.sort((a, b) => a - b)[3];
    }, question);
}

/** Share of a processor that a run paced by the clock takes, without pages or with one that reads everything. */
async function share_of_run(with_page) {
    const server = spawn(command, ["live", `${folder}/viewer.toml`, "--view", "--out", `${folder}/live`], { stdio: ["ignore", "pipe", "ignore"] }), ended = new Promise(done => server.on("exit", done));
    const { port } = await new Promise(done => server.stdout.once("data", text => done(new URL(/http:\S+/.exec(String(text))[0]))));
    const client = net.connect(Number(port), "127.0.0.1").on("error", () => {});
    if (with_page) client.write(`GET / HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n`);
    client.resume();
    await passed(3000);
    const begin = cpu_of(server.pid);
    await passed(20000);
    const share = (cpu_of(server.pid) - begin) / 200;
    client.destroy();
    server.kill("SIGINT");
    await ended;
    return share.toFixed(1);
}

console.log(`load ${os.loadavg()[0].toFixed(1)} at the beginning\n\n| what | goal | takes |\n|---|--:|--:|`);
await with_page(`file://${folder}/swarm.html`, frames_of_a_swarm);
row("`view -o` of the large run", "4 s", `${cpu_of_command("view", `${folder}/large`, "-o", `${folder}/large.html`).toFixed(1)} s`);
await with_page(`file://${folder}/large.html`, large_run);
await served(`${folder}/large`, async (address, cpu) => {
    row("`view` of the large run, until its server answers", "2 s", `${cpu.toFixed(1)} s`);
    await with_page(address, async ({ page }) => {
        row("answer why a robot missed a message, in the large run (elapsed time)", "50 ms", `${(await answered(page, { op: "why", uid: 6000, robot: 7 })).toFixed(0)} ms`);
        row("answer with the link budget of two robots, in the large run", "50 ms", `${(await answered(page, { op: "pair", a: 1, b: 2, t_ns: 30e9 })).toFixed(0)} ms`);
    });
});
await served(rescue, address => with_page(address, async ({ page }) => {
    row("answer with the coverage of 200,000 cells of the example `rescue`", "300 ms", `${(await answered(page, { op: "coverage", robot: 1, t_ns: 10e9, storey: 0, cells: 200000 })).toFixed(0)} ms`);
}));
for (const with_page of [false, true]) row(`a run of 126,000 receptions/s in real time, ${with_page ? "with one page" : "without pages"}`, with_page ? "5 % more" : "", `${await share_of_run(with_page)} % of a processor`);
const page = fs.readFileSync(`${folder}/swarm.html`, "utf8").replace(/(<script[^>]*id="run"[^>]*>)[^<]*/, "$1");
row("size of the page without a run", "150 kB", `${(page.length / 1e3).toFixed(0)} kB`);
row("size of the page without a run, compressed by gzip", "45 kB", `${(zlib.gzipSync(page, { level: 9 }).length / 1e3).toFixed(0)} kB`);
console.log(`\nload ${os.loadavg()[0].toFixed(1)} at the end`);

// SPDX-License-Identifier: MIT
// Pages in a browser: one browser for all tests; a page that breaks a rule fails its test.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { chromium } from "playwright-core";

export const { FOLDER: folder, COMMAND: command, CHROMIUM: chromium_path } = process.env;
const idle_ms = 3000, viewport = { width: 1280, height: 720 };
let shared = null, emptied = null, closing;

/** A browser with further arguments. */
export function launched(...args) {
    return chromium.launch({ executablePath: chromium_path, args: ["--no-sandbox", "--enable-unsafe-swiftshader", ...args] });
}

/** The browser of all tests. It closes when no page was open for a while: a hook after all tests does not run if the last one is left out. */
async function browser_of_all() {
    clearTimeout(closing);
    return shared ??= await launched();
}

function close_later() {
    clearTimeout(closing);
    closing = setTimeout(() => {
        shared?.close();
        shared = emptied = null;
    }, idle_ms);
}

/** What the command prints. */
export function printed(...words) { return execFileSync(command, words, { maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"], encoding: "utf8" }); }

/** JSON that the command prints. */
export function told(...words) { return JSON.parse(printed(...words)); }

/** Scenario of a run. */
export function scenario(name) { return fs.readFileSync(path.join(folder, name, "scenario.path"), "utf8").trim(); }

/** Recorded trace of a run. */
export function trace(name) { return path.join(folder, name, "trace.mcap"); }

/** A tab in a new window of the browser, with helpers for tests in each page that it shows. */
async function new_tab(browser, context_options = {}) {
    const context = await browser.newContext({ viewport, ...context_options });
    context.setDefaultTimeout(15000);
    await context.addInitScript(() => document.addEventListener("securitypolicyviolation", event => console.error(`violates ${event.violatedDirective}`)));
    await context.addInitScript(() => {
        /** Place of a robot on the map [px]. */
        window.pixel = robot => ["x", "y"].map(axis => rovernet.parts.robots.at[axis][robot]);
        /** Links that the map of a run shows. */
        window.links_shown = run => {
            const { state, parts: { links } } = rovernet;
            return state.links ? links.shown(state, run).map(link => ({ ...link, ...links.look(link.margin) })) : [];
        };
        /** What became of a message at a robot. */
        window.outcome = async (uid, robot) => {
            const { floods, sides } = rovernet.parts, { run, blocks } = sides.own.all[sides.lead()], message = run.by_uid.get(uid);
            return message === undefined ? "unknown" : floods.outcome(run, await floods.of(run, blocks, message), robot);
        };
        /** Levels of the coverage with the pixels of their cells. */
        window.levels = () => {
            const { camera, coverage } = rovernet.parts, heat = coverage.heat();
            return heat ? heat.dbm.map((dbm, i) => ({ dbm, x: camera.to_x(heat.left + (i % heat.columns + 0.5) * heat.cell_width), y: camera.to_y(heat.bottom + (Math.floor(i / heat.columns) + 0.5) * heat.cell_height) })) : [];
        };
    });
    return { context, page: await context.newPage() };
}

/** Tab for a test: a new one if the test has options for it, otherwise the emptied tab of the test before. To open a tab takes most of a second. */
async function tab_for({ browser, context, fresh }) {
    const in_browser = browser ?? await browser_of_all();
    if (browser || context || fresh) return new_tab(in_browser, context);
    const tab = emptied ?? { ...await new_tab(in_browser), is_shared: true };
    emptied = null;
    return tab;
}

/** Empties a tab for the next test. */
async function empty({ context, page }) {
    page.removeAllListeners();
    for (const other of context.pages()) if (other !== page) await other.close();
    await page.setViewportSize(viewport);
    await page.mouse.move(0, 0);
    await page.goto("about:blank");
}

/** Opens an address, does something, and holds the page to be free of errors and of foreign requests. */
async function watched(url, options, act) {
    const tab = await tab_for(options), { context, page } = tab, faults = [], requests = [];
    await context.setOffline(url.startsWith("file:"));
    page.on("console", message => { if (["error", "warning"].includes(message.type()) && !options.faults?.test(message.text())) faults.push(message.text()); });
    page.on("pageerror", error => faults.push(error.message));
    page.on("dialog", dialog => { faults.push("a dialog"); dialog.dismiss(); });
    page.on("request", request => requests.push(request.url()));
    try {
        await page.goto(url);
        await page.waitForFunction(() => window.rovernet && (window.rovernet.error || window.rovernet.ready && window.rovernet.frames > 0));
        await act(page, context);
        assert.match(await page.evaluate(() => window.rovernet.error), options.error ?? /^$/);
        assert.deepEqual(faults, []);
        if (tab.is_shared) {
            await empty(tab);
            emptied = tab;
        }
        return requests.filter(request => !request.startsWith("blob:"));
    } finally {
        if (emptied !== tab) await context.close();
        close_later();
    }
}

/** Opens a written page with the network off: it asks for itself and for nothing else. */
export async function with_page(name, options, act) {
    const file = path.isAbsolute(name) ? name : `${folder}/${name}.html`, requests = await watched(`file://${file}${options.hash ?? ""}`, options, act);
    assert.deepEqual(requests.filter(request => request.split("#")[0] !== `file://${file}`), []);
    assert.equal(requests.length, 1);
}

/** Serves a run or a scenario until `act` is done: act(address, process). */
export function with_server(file, act) { return with_command(["view", file], act); }

/** Runs a command that serves a page until `act` is done: act(address, process, its end as an exit code). */
export async function with_command(words, act) {
    const server = spawn(command, words, { stdio: ["ignore", "pipe", "ignore"] });
    const ended = new Promise(done => server.on("exit", done));
    try {
        const address = await new Promise((done, failed) => {
            let text = "";
            server.stdout.on("data", part => {
                text += part;
                const found = /http:\/\/\S+/.exec(text);
                if (found && text.includes("\n")) done(found[0]);
            });
            server.on("exit", code => failed(new Error(`the server ended with ${code}: ${text}`)));
        });
        await act(address, server, ended);
    } finally {
        server.kill("SIGINT");
        await ended;
    }
}

/** Opens a served page, which asks its own server only. */
export async function with_served(address, options, act) {
    const requests = await watched(address + (options.hash ?? ""), options, act);
    assert.deepEqual(requests.filter(request => !request.startsWith(address)), []);
}

/** Waits until what was asked for is drawn: the page draws with the next frame, and again when a block has come. */
export async function drawn(page) {
    await page.evaluate(async () => {
        const frame = () => new Promise(done => requestAnimationFrame(done));
        await frame();
        for (let i = 0; i < 600 && !window.rovernet.whole; i++) await frame();
    });
}

/** Number of colours of the map. */
export function colors(page) {
    return page.evaluate(() => {
        const canvas = document.getElementById("map"), seen = new Set();
        const pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
        for (const pixel of pixels) seen.add(pixel);
        return seen.size;
    });
}

/** Largest distance [m] between robots on the page and where the command says, at times all over the run. */
export async function most_apart(page, name, duration_ns, count) {
    const times = Array.from({ length: count }, (_, i) => Math.round((i * 0.618034 % 1) * duration_ns / 1e3) * 1e3).sort((a, b) => a - b);
    const truth = told("where", scenario(name), "--at", times.map(t => `${t / 1e9}s`).join(","), "--json").times;
    const found = await page.evaluate(asked => asked.map(({ t, count: robots }) => {
        window.rovernet.seek(t);
        return Array.from({ length: robots }, (_, i) => window.rovernet.position(i));
    }), truth.map((row, i) => ({ t: times[i], count: row.robots.length })));
    let most = 0;
    truth.forEach((row, i) => row.robots.forEach((robot, k) => {
        if (robot.presence === "not_departed" || robot.presence === "left") return;
        most = Math.max(most, Math.hypot(robot.x_m - found[i][k].x, robot.y_m - found[i][k].y, robot.z_m - found[i][k].z));
    }));
    return most;
}

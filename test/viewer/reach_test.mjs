// SPDX-License-Identifier: MIT
// Who gets to a page: a token that its tab keeps, and a browser that the command opens.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import { command, folder, scenario, with_command, with_served } from "./page.mjs";

/** Address on this machine of a server that others reach, too. */
const here = address => address.replace(/\/\/[^:/]+:/, "//127.0.0.1:");

for (const [what, words] of [["view", ["view", path.join(folder, "rescue")]], ["run --view", ["run", scenario("rescue"), "--view", "--out", path.join(folder, "reached")]]]) {
    test(`--listen: a page of ${what} removes the token from its address and can be reloaded; another tab needs the token`, () =>
        with_command([...words, "--listen", "0.0.0.0"], address => {
            const whole = here(address), bare = whole.split("?")[0], faults = { faults: /403/ };
            assert.match(whole, /\?token=[0-9a-f]{32}$/);
            return with_served(bare, { hash: whole.slice(bare.length), ...faults }, async (page, context) => {
                assert.equal(page.url().includes("token"), false);
                await page.reload();
                await page.waitForFunction(() => window.rovernet?.ready);
                assert.equal(await page.evaluate(() => rovernet.error), "");
                // Another tab has no token: it is told.
                const other = await context.newPage();
                await other.goto(bare);
                await other.waitForFunction(() => /token/.test(document.getElementById("notice").textContent));
                await other.close();
            });
        }));
}

/** Runs view --open with a folder of programs, until it serves and `is_done(text)`: what it says. */
async function opened(programs, is_done) {
    const server = spawn(command, ["view", path.join(folder, "rescue"), "--open"], { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, PATH: programs } });
    let text = "";
    const ended = new Promise(done => server.on("close", done));
    for (const stream of [server.stdout, server.stderr]) stream.on("data", part => text += part);
    while (!/until Ctrl-C/.test(text) || !is_done(text)) await new Promise(done => setImmediate(done));
    server.kill("SIGINT");
    assert.equal(await ended, 0);
    return text;
}

test("view --open: xdg-open opens the address; if xdg-open is missing, the command prints the address", async () => {
    const [with_it, without] = ["with-browser", "without-browser"].map(name => path.join(folder, name));
    for (const each of [with_it, without]) fs.mkdirSync(each);
    fs.writeFileSync(path.join(with_it, "xdg-open"), `#!/bin/sh\necho "$1" > ${with_it}/part && /bin/mv ${with_it}/part ${with_it}/opened\n`, { mode: 0o755 });
    const address = /http:\S+/.exec(await opened(with_it, () => fs.existsSync(path.join(with_it, "opened"))))[0];
    assert.equal(fs.readFileSync(path.join(with_it, "opened"), "utf8").trim(), address);
    assert.match(await opened(without, text => /in a browser/.test(text)), /xdg-open is not installed; open http:\S+ in a browser/);
});

test("view --open: Ctrl-C right after the address was printed ends the server with exit code 0", () => opened("/nowhere", () => true));

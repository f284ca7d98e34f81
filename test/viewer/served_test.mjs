// SPDX-License-Identifier: MIT
// Served page: what it asks its server is what the command line prints; who may ask; two tabs.
import assert from "node:assert/strict";
import net from "node:net";
import path from "node:path";
import test from "node:test";
import { drawn, folder, scenario, told, trace, with_served, with_server } from "./page.mjs";
import { sections, view_file } from "./run_file.mjs";

const shown = { view: { x: 24, y: 12, scale: 15 } };

/** Pixel of a place of the map, in the view above. */
function pixel(box, x, y) { return [box.width / 2 + (x - shown.view.x) * shown.view.scale, box.height / 2 - (y - shown.view.y) * shown.view.scale]; }

/** Number as the page writes it, with 4 digits that count. */
function written(value) { return String(Number(value.toPrecision(7))).replace("-", "\u2212"); }

/** Colours of places of the map, as numbers. */
function colors_at(page, places) {
    return page.evaluate(asked => {
        const canvas = document.getElementById("map"), ratio = canvas.width / canvas.clientWidth, copy = document.createElement("canvas");
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const c = copy.getContext("2d");
        c.drawImage(canvas, 0, 0);
        const pixels = new Uint32Array(c.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
        return asked.map(([x, y]) => pixels[Math.round(y * ratio) * canvas.width + Math.round(x * ratio)]);
    }, places);
}

test("served view page: the link budget of two robots equals the output of the command link, and each wall between them is highlighted", () => with_server(path.join(folder, "rescue"), address => with_served(address, {}, async page => {
    const links = [["A", "E"], ["E", "A"]].map(pair => told("link", scenario("rescue"), ...pair, "--at", "10s", "--json"));
    await page.evaluate(state => window.rovernet.select({ ...state, t: 10e9, robots: [0, 4], trails: false, panel: "pair" }), shown);
    await drawn(page);
    const box = await page.locator("#map").boundingBox();
    const [a, e] = await page.evaluate(() => [0, 4].map(window.rovernet.position)), apart = Math.hypot(a.x - e.x, a.y - e.y);
    const asides = links[0].walls.flatMap(wall => [-2.5, 2.5].map(aside => {
        const share = (wall.entry_m + wall.exit_m) / 2 / links[0].distance_m, [x, y] = pixel(box, a.x + share * (e.x - a.x), a.y + share * (e.y - a.y));
        return [x + aside * (e.y - a.y) / apart, y + aside * (e.x - a.x) / apart];
    }));
    const before = await colors_at(page, asides);
    await page.getByText("budget at this time").click();
    await page.waitForFunction(() => document.querySelectorAll("#pair-answer h3").length === 2);
    await drawn(page);
    const after = await colors_at(page, asides);
    assert.ok(links[0].walls.length > 1);
    after.forEach((color, i) => assert.notEqual(color, before[i], `wall ${i >> 1} is not lit`));
    const told_walls = await page.$$eval("#pair-answer .table", all => all.map(one => [...one.querySelectorAll("tbody tr")].map(row => [...row.children].map(cell => cell.textContent))));
    const facts = await page.$$eval("#pair-answer dl", all => all.map(one => Object.fromEntries([...one.querySelectorAll("dt")].map(name => [name.textContent, name.nextElementSibling.textContent]))));
    links.forEach((link, i) => {
        assert.deepEqual(told_walls[i], link.walls.map(wall => [wall.material, ...[wall.entry_m, wall.length_m, wall.loss_db].filter(v => v !== undefined).map(written)]));
        const numbers = Object.entries(link).filter(([, value]) => typeof value === "number");
        assert.ok(numbers.length > 5);
        for (const [key, value] of numbers) {
            const name = Object.keys(facts[i]).find(title => title.replace(" [", "_").replace("]", "").replaceAll(" ", "_").toLowerCase() === key.toLowerCase());
            assert.equal(facts[i][name], written(value), key);
        }
    });
})));

test("served view page: the level shown at the pointer equals the coverage computed by the server", () => with_server(path.join(folder, "rescue"), address => with_served(address, {}, async page => {
    await page.evaluate(state => window.rovernet.select({ ...state, t: 10e9, robots: [1], panel: "robot" }), shown);
    await page.getByRole("button", { name: "coverage", exact: true }).click();
    await page.waitForFunction(() => document.getElementById("legend").textContent.includes("coverage of B"));
    await drawn(page);
    const truth = await page.evaluate(() => new Promise(done => {
        const socket = new WebSocket(location.href.replace("http", "ws").split("#")[0]);
        socket.onopen = () => socket.send(JSON.stringify({ id: 1, op: "coverage", robot: 1, t_ns: 10e9, storey: 0, cells: 60000 }));
        socket.onmessage = event => {
            done(JSON.parse(event.data));
            socket.close();
        };
    }));
    const box = await page.locator("#map").boundingBox(), off = 0.5 / shown.view.scale;
    let seen = 0;
    for (const [x, y] of [[3, 12], [12.2, 11.7], [20, 5], [30.4, 20.3], [45, 12], [24, 12.05]]) {
        const [px, py] = pixel(box, x, y).map(Math.round);
        await page.mouse.move(box.x + px, box.y + py);
        const text = await page.locator("#status").textContent();
        // A pixel is a place within a cell or on its edge.
        const cells = [-off, off].flatMap(dx => [-off, off].map(dy => {
            const column = Math.floor((x + dx - truth.left) / truth.cell_width), row = Math.floor((y + dy - truth.bottom) / truth.cell_height);
            return truth.dbm[row * truth.columns + column];
        }));
        assert.ok(cells.some(dbm => text === `${dbm.toFixed(1).replace("-", "\u2212")} dBm`), `at ${x} m, ${y} m: ${text}, not ${cells}`);
        seen++;
    }
    assert.equal(seen, 6);
    // Beside the receiver, its link has that level.
    const link = told("link", scenario("rescue"), "B", "C", "--at", "10s", "--json"), c = await page.evaluate(() => window.rovernet.position(2));
    const level = truth.dbm[Math.floor((c.y - truth.bottom) / truth.cell_height) * truth.columns + Math.floor((c.x - truth.left) / truth.cell_width)];
    assert.ok(Math.abs(level - link.rx_power_dbm) < 3, `${level} dBm in the coverage, ${link.rx_power_dbm} in the link`);
})));

test("served view page: the button why? shows the sentence that the command trace follow prints", () => with_server(path.join(folder, "rescue"), address => with_served(address, {}, async page => {
    const { head } = sections(view_file("rescue")), uids = [...new Set(head.follow.map(row => row.message))].slice(0, 3);
    let asked = 0;
    for (const uid of uids) {
        await page.evaluate(message => window.rovernet.select({ message, panel: "message" }), uid);
        await page.waitForFunction(message => document.querySelector("#message-panel h2")?.textContent === `message ${message}`, uid);
        const names = await page.$$eval("#message-panel ul.plain > li", rows => rows.filter(row => row.querySelector("button.small")).map(row => row.querySelector("button.link").textContent));
        for (const name of names) {
            const { answer, frames } = told("trace", "follow", trace("rescue"), "--message", String(uid), "--robot", name, "--json").at_robot;
            const row = page.locator("#message-panel ul.plain > li:not(.wide)").filter({ has: page.getByRole("button", { name, exact: true }) });
            await row.getByText("why?").click();
            await row.getByText("why?").waitFor({ state: "detached" });
            assert.equal(await row.locator("span span").first().textContent(), answer.slice(name.length + 1));
            const rows = await page.locator("#message-panel li.wide tbody tr").count();
            if (frames.length) assert.ok(rows >= frames.length);
            asked++;
        }
    }
    assert.ok(asked > 2, `${asked} were asked`);
})));

/** Answer to a request as it stands: status line, header, body; "" if the server closes without one. */
function answer_to(port, request) {
    return new Promise((done, failed) => {
        const socket = net.connect(port, "127.0.0.1", () => socket.write(request));
        let text = "";
        socket.setEncoding("latin1");
        socket.on("data", part => {
            text += part;
            if (text.startsWith("HTTP/1.1 101 ")) socket.destroy();
        });
        socket.on("error", error => text ? done(text) : error.code === "ECONNRESET" ? done("") : failed(error));
        socket.on("close", () => done(text));
    });
}

test("view server: valid requests are answered; foreign hosts and pages, other methods and unknown paths are refused", () => with_server(path.join(folder, "rescue"), async address => {
    const port = Number(new URL(address).port), own = `127.0.0.1:${port}`;
    const request = (line, ...fields) => `${line} HTTP/1.1\r\n${fields.map(field => field + "\r\n").join("")}\r\n`;
    const upgrade = ["Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13"], key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    const rows = [
        [request("GET /", `Host: ${own}`), 200, "<!doctype html>"],
        [request("GET /", `Host: localhost:${port}`), 200, "connect-src 'self'"],
        [request("GET /?token=unknown", `Host: ${own}`), 200, "<!doctype html>"],
        [request("HEAD /", `Host: ${own}`), 200, ""],
        [request("GET /run.rvw", `Host: ${own}`, `Origin: http://${own}`), 200, "RVW1"],
        [request("GET /", `Host: rebound.example:${port}`), 403, `expected ${own}`],
        [request("GET /", "Host: 127.0.0.1"), 403, "Host: found \"127.0.0.1\""],
        [request("GET /"), 400, "expected one header Host"],
        [request("GET /", `Host: ${own}`, `Host: ${own}`), 400, "expected one header Host"],
        [request("GET /run.rvw", `Host: ${own}`, "Origin: http://page.example"), 403, "needs the token"],
        [request("GET /run.rvw", `Host: ${own}`, "Origin: null"), 403, "needs the token"],
        [request("GET /run.rvw?token=0123", `Host: ${own}`, "Origin: http://page.example"), 403, "needs the token"],
        [request("POST /", `Host: ${own}`, "Content-Length: 0"), 405, "expected GET or HEAD"],
        [request("GET /../../etc/passwd", `Host: ${own}`), 404, "there is no such page"],
        [request("GET /nothing", `Host: ${own}`), 404, "there is no such page"],
        [request("GET /nothing", `Host: ${own}`, ...upgrade, key), 101, ""],
        [request("GET /", `Host: ${own}`, ...upgrade, "Sec-WebSocket-Key: short"), 400, "expected 16 bytes in base64"],
        [request("GET /", `Host: ${own}`, ...upgrade, key, "Origin: http://page.example"), 403, "needs the token"],
        [request("GET /", `Host: ${own}`, `X: ${"x".repeat(9000)}`), 0, ""]
    ];
    for (const [text, status, words] of rows) {
        const answer = await answer_to(port, text), body = answer.slice(answer.indexOf("\r\n\r\n") + 4);
        assert.equal(answer ? Number(answer.slice(9, 12)) : 0, status, text.slice(0, 200));
        assert.ok(body.includes(words), `${text.slice(0, 200)}${body.slice(0, 200)}`);
        if (text.startsWith("HEAD")) assert.equal(body, "");
        if (status === 405) assert.match(answer, /\r\nAllow: GET, HEAD\r\n/);
    }
}));

test("view server: two tabs get separate answers, and a page reports that its server has ended", () => with_server(path.join(folder, "rescue"), (address, server) => with_served(address, {}, async (page, context) => {
    const other = await context.newPage();
    await other.goto(address);
    await other.waitForFunction(() => window.rovernet?.ready);
    const ask = async (tab, robots) => {
        await tab.evaluate(chosen => window.rovernet.select({ t: 10e9, robots: chosen, panel: "pair" }), robots);
        await tab.getByText("budget at this time").click();
    };
    await Promise.all([ask(page, [0, 1]), ask(other, [1, 2])]);
    const titles = tab => tab.locator("#pair-answer h3").allTextContents();
    for (const [tab, expected] of [[page, ["A \u2192 B", "B \u2192 A"]], [other, ["B \u2192 C", "C \u2192 B"]]]) {
        await tab.waitForFunction(() => document.querySelectorAll("#pair-answer h3").length === 2);
        assert.deepEqual(await titles(tab), expected);
    }
    await other.close();
    await ask(page, [0, 2]);
    await page.waitForFunction(() => document.querySelector("#pair-answer h3")?.textContent === "A \u2192 C");
    const gone = new Promise(done => server.on("exit", done));
    server.kill("SIGINT");
    assert.equal(await gone, 0);
    await page.evaluate(() => window.rovernet.select({ robots: [3, 2] }));
    await page.getByText("budget at this time").click().catch(() => {});
    await page.waitForFunction(() => /server has gone/.test(document.getElementById("pair-answer").textContent));
}).catch(error => {
    // The browser tells of the connection that is refused: the page cannot prevent it.
    if (!/ERR_CONNECTION_REFUSED/.test(String(error.message))) throw error;
})));

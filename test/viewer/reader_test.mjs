// SPDX-License-Identifier: MIT
// Reader of view files without a browser: sums, types, damaged bytes.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import zlib from "node:zlib";
import { is_short } from "./made_page.mjs";
import { html, reader, sections, view_file } from "./run_file.mjs";

const { FOLDER: folder, PAGE: page } = process.env;
const { rvw, run, blocks, events } = reader();
const unpack = async (packed, most) => zlib.inflateRawSync(packed, { maxOutputLength: Math.max(1, most) });

/** Opens a view file and reads all of it. */
async function read_all(bytes) {
    const opened = await run.load(rvw.open(bytes, unpack)), all = new blocks.Blocks(opened);
    let receptions = 0, shown = 0;
    for (let n = 0; n < all.info.length; n++) {
        const block = await all.load(n), before = n ? await all.load(n - 1) : null;
        receptions += block.robot.length;
        const window = events.window_of(opened, n, block, before);
        shown += window.time.length;
        for (let i = 1; i < window.time.length; i++) assert.ok(window.time[i - 1] <= window.time[i]);
    }
    return { opened, receptions, shown };
}

test("view page, types: the TypeScript compiler accepts the page's JavaScript files", () => {
    const files = fs.readdirSync(page).filter(file => file.endsWith(".js")).map(file => path.join(page, file));
    execFileSync(process.execPath, [path.join(folder, "node_modules/typescript/bin/tsc"), "--checkJs", "--noEmit", "--strict",
        "--target", "es2022", "--lib", "es2022,dom,dom.iterable", ...files], { stdio: "inherit" });
});

test("view page, files: order.txt lists each script once, and no script has more than 300 lines or writes HTML markup", () => {
    const files = fs.readdirSync(page).filter(file => file.endsWith(".js"));
    const order = fs.readFileSync(path.join(page, "order.txt"), "utf8").trim().split("\n");
    assert.deepEqual([...order].sort(), files.sort());
    for (const file of files) {
        const text = fs.readFileSync(path.join(page, file), "utf8");
        assert.ok(text.startsWith("// SPDX-License-Identifier: MIT\n"), file);
        assert.ok(text.split("\n").length <= 301, `${file} is too long`);
        assert.ok(!/innerHTML|outerHTML|insertAdjacentHTML|\beval\(|new Function/.test(text), `${file} writes markup`);
    }
});

test("view page, size: the page has at most 150 kB, or 45 kB compressed; with the run rescue at most 250 kB", { skip: !is_short && "the page was built without minify" }, () => {
    const whole = html("rescue"), bare = whole.replace(/(<script[^>]*id="run"[^>]*>)[^<]*/, "$1"), packed = zlib.gzipSync(bare, { level: 9 });
    assert.ok(bare.length <= 150_000, `${bare.length} bytes`);
    assert.ok(packed.length <= 45_000, `${packed.length} bytes packed`);
    assert.ok(whole.length <= 250_000, `${whole.length} bytes`);
});

for (const name of ["rescue", "storeys", "routes", "patrol", "csma"]) {
    test(`view file: in the file of ${name}, all data blocks together, and each zoom level of the time line, count every reception`, async () => {
        const bytes = view_file(name), { head, unpacked } = sections(bytes), { receptions, shown, opened } = await read_all(bytes);
        assert.ok(head.counts.receptions > 0);
        assert.equal(receptions, head.counts.receptions);
        assert.equal(head.counts.outcomes.reduce((a, b) => a + b), receptions);
        head.density.forEach((level, i) => {
            const part = unpacked.get(`density.${i}`), counts = new Uint32Array(part.buffer.slice(part.byteOffset, part.byteOffset + part.length));
            assert.equal(counts.reduce((a, b) => a + b), receptions, `level ${i}`);
        });
        const others = ["messages.created", "doors.time", "states.time", "drops.time"].reduce((sum, column) => sum + opened.col(column).length, 0);
        assert.equal(shown, receptions + head.counts.flights + others);
    });
}

/** Damages bytes at random: flips, cuts, doubles, zeros. */
function mutated(bytes, random) {
    const out = Buffer.from(bytes), at = Math.floor(random() * out.length);
    switch (Math.floor(random() * 5)) {
        case 0: out[at] ^= 1 << Math.floor(random() * 8); return out;
        case 1: return out.subarray(0, at);
        case 2: out.fill(0, at, Math.min(out.length, at + 16)); return out;
        case 3: out.copy(out, at, Math.floor(random() * out.length)); return out;
        default: for (let i = 0; i < 20; i++) out[Math.floor(random() * out.length)] = Math.floor(random() * 256); return out;
    }
}

/** Another number in the head: what a flipped bit seldom meets. */
function changed_head(bytes, random) {
    const length = bytes.readUInt32LE(4), text = bytes.subarray(8, 8 + length).toString();
    const places = [...text.matchAll(/-?\d+(\.\d+)?/g)], place = places[Math.floor(random() * places.length)];
    const values = ["-1", "0", "1e300", "4294967296", "1.5", "null", "\"x\"", "[]", "999999"], value = values[Math.floor(random() * values.length)];
    const head = Buffer.from(text.slice(0, place.index) + value + text.slice(place.index + place[0].length));
    const begin = Buffer.from("RVW1\0\0\0\0");
    begin.writeUInt32LE(head.length, 4);
    return Buffer.concat([begin, head, bytes.subarray(8 + length)]);
}

test("view file: each of 10,000 damaged files is read, or refused with a sentence, within a second", async () => {
    const bytes = view_file("storeys");
    let seed = 1, refused = 0, slowest = 0;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    for (let i = 0; i < 10_000; i++) {
        const broken = i % 4 === 0 ? changed_head(bytes, random) : mutated(bytes, random), begin = performance.now();
        try {
            await read_all(broken);
        } catch (error) {
            assert.ok(error instanceof rvw.ViewError, `file ${i}: ${error.stack}`);
            assert.match(error.message, /^[A-Z].*[.]$/);
            refused++;
        }
        slowest = Math.max(slowest, performance.now() - begin);
    }
    assert.ok(refused > 5_000, `only ${refused} were refused`);
    assert.ok(slowest < 1_000, `${slowest} ms`);
});

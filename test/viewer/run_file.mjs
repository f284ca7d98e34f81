// SPDX-License-Identifier: MIT
// View files inside written pages, and the page's own reader outside a browser.
import fs from "node:fs";
import path from "node:path";
import vm from "node:vm";
import zlib from "node:zlib";

const { FOLDER: folder, PAGE: page } = process.env;

/** Text of a page that was written. */
export function html(name) { return fs.readFileSync(path.join(folder, `${name}.html`), "utf8"); }

/** Bytes of the view file in a page. */
export function view_file(name) {
    return Buffer.from(/<script[^>]*id="run"[^>]*>([^<]*)</.exec(html(name))[1], "base64");
}

/** Head and unpacked sections, read without the page's code. */
export function sections(bytes) {
    const length = bytes.readUInt32LE(4), head = JSON.parse(bytes.subarray(8, 8 + length));
    const unpacked = new Map();
    for (const s of head.sections) {
        unpacked.set(s.name, zlib.inflateRawSync(bytes.subarray(8 + length + s.offset, 8 + length + s.offset + s.bytes)));
    }
    return { head, unpacked };
}

/** The page's files that read a run, as a script of their own. */
export function reader() {
    const files = ["theme.js", "head_check.js", "rvw.js", "run.js", "blocks.js", "signs.js", "events.js", "floods.js"];
    const text = files.map(file => fs.readFileSync(path.join(page, file), "utf8")).join("\n");
    const names = "({ rvw, run, blocks, events, floods, signs })";
    return vm.runInThisContext(`(() => {${text}\nreturn ${names};})()`);
}

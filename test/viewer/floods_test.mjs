// SPDX-License-Identifier: MIT
// The way of a message, from blocks of frames that are made here.
import assert from "node:assert/strict";
import test from "node:test";
import { reader } from "./run_file.mjs";

const { floods } = reader();
const delivered = 1;

/** Flood of message 0 of robot 0, created in the first of some blocks of 1 s each. @param {number} count of blocks @param {number[]} sent number of the block of each frame @param {Record<string, number[]>} columns */
function flood_of(count, sent, columns) {
    const values = { "messages.created": [5e8], "messages.origin": [0], "messages.to": [65535], ...columns };
    const read = [], all = {
        info: Array.from({ length: count }, () => ({})),
        at: t => Math.floor(t / 1e9),
        load: async n => {
            const flights = sent.filter(block => block === n).length;
            read.push(n);
            return {
                flights, message: Array(flights).fill(0), sender: Array(flights).fill(0), hops: Array(flights).fill(1), first: Array.from({ length: flights + 1 }, (_, i) => i),
                robot: Array(flights).fill(1), outcome: Array(flights).fill(delivered), end: () => n * 1e9
            };
        }
    };
    return floods.of({ robots: 2, columns: values, col: name => values[name] }, all, 0).then(flood => ({ ...flood, read }));
}

test("view page, search for a message's frames: a frame in data block 30 is found, and no earlier block is read", async () => {
    const flood = await flood_of(40, [30], { "messages.frames": [1], "messages.block": [30] });
    assert.deepEqual([flood.frames, flood.whole, flood.left_out, flood.first.get(1).at], [1, true, 0, 30e9]);
    assert.deepEqual(flood.read, [30]);
});

test("view page, search for a message's frames: in a live run, the data blocks from the message's creation to the last one are searched", async () => {
    const flood = await flood_of(300, [250], {});
    assert.deepEqual([flood.frames, flood.whole, flood.left_out], [1, true, 0]);
});

test("view page, search for a message's frames: frames that the page leaves out are counted", async () => {
    const some = await flood_of(4, [1, 3], { "messages.frames": [5], "messages.block": [1] });
    assert.deepEqual([some.frames, some.whole, some.left_out], [2, true, 3]);
    const none = await flood_of(4, [], { "messages.frames": [5], "messages.block": [4294967295] });
    assert.deepEqual([none.frames, none.whole, none.left_out, none.read.length], [0, true, 5, 0]);
});

test("view page, search for a message's frames: a search that stops early says that it is not complete", async () => {
    const flood = await flood_of(1000, [0, 900], { "messages.frames": [2], "messages.block": [0] });
    assert.deepEqual([flood.frames, flood.whole], [1, false]);
    assert.ok(flood.read.length < 100);
});

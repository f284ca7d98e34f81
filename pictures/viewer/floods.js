// SPDX-License-Identifier: MIT
// Way of a message: who had it from whom, and what became of it elsewhere.
/** @typedef {{at: number, from: number, hops: number, sign: number}} Copy */
/** Whole: all blocks that may tell of it were read. Left out: its frames that the page has not. @typedef {{message: number, first: Map<number, Copy>, lost: Map<number, Copy[]>, frames: number, whole: boolean, left_out: number}} Flood */
const floods = (() => {
    "use strict";
    const most_blocks = 32, most_lost = 20;

    /** Adds what a block tells of a message. @param {Flood} flood @param {Block} block */
    function add(flood, block) {
        for (let i = 0; i < block.flights; i++) {
            if (block.message[i] !== flood.message) continue;
            flood.frames++;
            const sender = block.sender[i];
            for (let k = block.first[i]; k < block.first[i + 1]; k++) {
                const robot = block.robot[k], sign = signs.of(block.outcome[k]);
                const copy = { at: block.end(i), from: sender, hops: block.hops[i], sign };
                const had = flood.first.get(robot);
                if (sign <= 1 && (!had || had.at > copy.at)) flood.first.set(robot, copy);
                if (sign <= 1) continue;
                const lost = flood.lost.get(robot) ?? [];
                if (lost.length < most_lost) lost.push(copy);
                flood.lost.set(robot, lost);
            }
        }
    }

    /** Reads from the first block with a frame of the message until all of its frames are known; of a run that goes on, all blocks since it was made. @param {Run} r @param {Blocks} all @param {number} message @returns {Promise<Flood>} */
    async function of(r, all, message) {
        /** @type {Flood} */
        const flood = { message, first: new Map(), lost: new Map(), frames: 0, whole: true, left_out: 0 };
        const [frames, begin] = ["frames", "block"].map(name => r.columns[`messages.${name}`]?.[message]);
        for (let n = begin ?? all.at(r.col("messages.created")[message]); n < all.info.length && flood.frames !== frames; n++) {
            flood.whole = !(n - begin >= most_blocks);
            if (!flood.whole) break;
            add(flood, await all.load(n));
        }
        if (flood.whole) flood.left_out = frames - flood.frames || 0;
        flood.first.delete(r.col("messages.origin")[message]);
        return flood;
    }

    /** Robots that should have the message. @param {Run} r @param {number} message @returns {number[]} */
    function wanted(r, message) {
        const to = r.col("messages.to")[message], origin = r.col("messages.origin")[message];
        return to < r.robots ? [to] : [...Array(r.robots).keys()].filter(i => i !== origin);
    }

    /** What happened to a message at a robot: name of a sign, or "nothing". @param {Run} r @param {Flood} flood @param {number} robot */
    function outcome(r, flood, robot) {
        if (robot === r.col("messages.origin")[flood.message]) return "origin";
        const first = flood.first.get(robot);
        if (first) return signs.kinds[first.sign].key;
        const lost = flood.lost.get(robot);
        return lost?.length ? signs.kinds[lost[lost.length - 1].sign].key : "nothing";
    }

    return { of, wanted, outcome };
})();

// SPDX-License-Identifier: MIT
// Way of a message: who had it from whom, and what became of it elsewhere.
/** @typedef {{at: number, from: number, hops: number, sign: number}} Copy */
/** @typedef {{message: number, first: Map<number, Copy>, lost: Map<number, Copy[]>, frames: number, whole: boolean}} Flood */
const floods = (() => {
    "use strict";
    const most_blocks = 6, most_lost = 20;

    /** Adds what a block tells of a message; true if it tells something. @param {Flood} flood @param {Block} block */
    function add(flood, block) {
        let some = false;
        for (let i = 0; i < block.flights; i++) {
            if (block.message[i] !== flood.message) continue;
            some = true;
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
        return some;
    }

    /** Reads on from the block in which the message was made until none tells of it. @param {Run} r @param {Blocks} all @param {number} message @returns {Promise<Flood>} */
    async function of(r, all, message) {
        /** @type {Flood} */
        const flood = { message, first: new Map(), lost: new Map(), frames: 0, whole: true };
        const begin = all.at(r.col("messages.created")[message]);
        let silent = 0;
        for (let n = begin; n < all.info.length && silent < 2; n++) {
            if (n - begin >= most_blocks) {
                flood.whole = false;
                break;
            }
            silent = add(flood, await all.load(n)) ? 0 : silent + 1;
        }
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

// SPDX-License-Identifier: MIT
// Events of a part of the run, in order of time: what the list shows and steps go through.
/** @typedef {{lo: number, hi: number, number: number, time: Float64Array, kind: Uint8Array, what: Uint32Array, flight: Uint32Array, of: Uint8Array, blocks: (Block|null)[]}} EventList */
const events = (() => {
    "use strict";
    const sent = 0, door = 1, state = 2, frame = 3, reception = 4, loss = 5;
    const kind_names = ["message sent", "door", "robot", "frame", "reception", "loss"];
    const state_words = ["switched off", "switched on", "arrived", "found no way", "has not departed", "left"];

    /** @param {Block} block @param {number} lo @param {number} hi @returns {{time: Float64Array, what: Uint32Array, flight: Uint32Array}} receptions that end in [lo, hi) */
    function receptions(block, lo, hi) {
        const order = [];
        for (let i = 0; i < block.flights; i++) {
            const end = block.end(i);
            if (end >= lo && end < hi) order.push(i);
        }
        let sorted = true;
        for (let i = 1; i < order.length && sorted; i++) sorted = block.end(order[i - 1]) <= block.end(order[i]);
        if (!sorted) order.sort((a, b) => block.end(a) - block.end(b));
        let count = 0;
        for (const i of order) count += block.first[i + 1] - block.first[i];
        const time = new Float64Array(count), what = new Uint32Array(count), flight = new Uint32Array(count);
        let n = 0;
        for (const i of order) {
            for (let k = block.first[i]; k < block.first[i + 1]; k++) {
                time[n] = block.end(i);
                what[n] = k;
                flight[n++] = i;
            }
        }
        return { time, what, flight };
    }

    /** @param {Numbers} times @param {number} lo @param {number} hi */
    function indexes(times, lo, hi) {
        const out = [];
        for (let i = 0; i < times.length; i++) if (times[i] >= lo && times[i] < hi) out.push(i);
        out.sort((a, b) => times[a] - times[b]);
        return { time: Float64Array.from(out, i => times[i]), what: Uint32Array.from(out), flight: new Uint32Array(out.length) };
    }

    /** Events of block `number` and of the time until the next one. @param {Run} r @param {number} number @param {Block|null} block @param {Block|null} before */
    function window_of(r, number, block, before) {
        const info = r.head.blocks, lo = number === 0 ? -Infinity : info[number].begin_ns;
        const hi = number + 1 < info.length ? info[number + 1].begin_ns : Infinity;
        const plain = Uint32Array.from({ length: block?.flights ?? 0 }, (_, i) => i);
        /** @type {[number, number, {time: Float64Array|Numbers, what: Uint32Array, flight: Uint32Array}][]} */
        const streams = [
            [sent, 0, indexes(r.col("messages.created"), lo, hi)],
            [door, 0, indexes(r.col("doors.time"), lo, hi)],
            [state, 0, indexes(r.col("states.time"), lo, hi)]
        ];
        if (block) streams.push([frame, 0, { time: block.start, what: plain, flight: plain }]);
        if (before) streams.push([reception, 1, receptions(before, lo, hi)]);
        if (block) streams.push([reception, 0, receptions(block, lo, hi)]);
        streams.push([loss, 0, indexes(r.col("drops.time"), lo, hi)]);
        return merged(streams, { lo, hi, number, blocks: [block, before] });
    }

    /** @param {[number, number, {time: Float64Array|Numbers, what: Uint32Array, flight: Uint32Array}][]} streams @param {{lo: number, hi: number, number: number, blocks: (Block|null)[]}} part @returns {EventList} */
    function merged(streams, part) {
        const count = streams.reduce((sum, s) => sum + s[2].what.length, 0), at = streams.map(() => 0);
        const out = { ...part, time: new Float64Array(count), kind: new Uint8Array(count), what: new Uint32Array(count), flight: new Uint32Array(count), of: new Uint8Array(count) };
        for (let n = 0; n < count;) {
            let best = -1, earliest = Infinity, next = Infinity;  // the earliest time of the other streams
            for (let s = 0; s < streams.length; s++) {
                const { time, what } = streams[s][2], first = at[s] < what.length ? time[at[s]] : Infinity;
                if (first < earliest || best < 0 && at[s] < what.length) [best, earliest, next] = [s, first, earliest];
                else if (first < next) next = first;
            }
            const [kind, of, { time, what, flight }] = streams[best];
            let i = at[best];
            do {
                out.time[n] = time[i];
                out.kind[n] = kind;
                out.of[n] = of;
                out.what[n] = what[i];
                out.flight[n++] = flight[i++];
            } while (i < what.length && time[i] < next);
            at[best] = i;
        }
        return out;
    }

    /** Robots and message of an event. @param {Run} r @param {EventList} w @param {number} i */
    function about(r, w, i) {
        const k = w.what[i], block = /** @type {Block} */ (w.blocks[w.of[i]]);
        switch (w.kind[i]) {
            case sent: return { who: r.col("messages.origin")[k], other: r.col("messages.to")[k], message: k, sign: -1 };
            case door: return { who: -1, other: -1, message: -1, sign: -1 };
            case state: return { who: r.col("states.robot")[k], other: -1, message: -1, sign: -1 };
            case loss: return { who: r.col("drops.robot")[k], other: -1, message: r.col("drops.message")[k], sign: -1 };
            case frame: return { who: block.sender[k], other: block.to[k], message: block.message[k], sign: -1 };
            default: return { who: block.robot[k], other: block.sender[w.flight[i]], message: block.message[w.flight[i]], sign: signs.of(block.outcome[k]) };
        }
    }

    /** Rows of the window that a filter lets through. @param {Run} r @param {EventList} w @param {Filter} filter */
    function filtered(r, w, filter) {
        const out = new Uint32Array(w.time.length), one = filter.robot >= 0 || filter.message >= 0, some = filter.signs !== selection.everything;
        let n = 0;
        for (let i = 0; i < out.length; i++) {
            if (!(filter.kinds >> w.kind[i] & 1)) continue;
            if (one || some && w.kind[i] === reception) {
                const { who, other, message, sign } = about(r, w, i);
                if (filter.robot >= 0 && who !== filter.robot && (w.kind[i] !== reception || other !== filter.robot)) continue;
                if (filter.message >= 0 && message !== filter.message) continue;
                if (sign >= 0 && !(filter.signs >> sign & 1)) continue;
            }
            out[n++] = i;
        }
        return out.subarray(0, n);
    }

    /** Words of an event. @param {Run} r @param {EventList} w @param {number} i */
    function text(r, w, i) {
        const k = w.what[i], { who, other, message, sign } = about(r, w, i), block = /** @type {Block} */ (w.blocks[w.of[i]]);
        /** @param {number} robot */
        const name = robot => robot >= 0 && robot < r.robots ? r.label(robot) : "all";
        const packet = r.message_text(message);
        switch (w.kind[i]) {
            case sent: return `${name(who)} sends ${packet} to ${name(other)}`;
            case door: {
                const d = r.head.map.doors[r.col("doors.door")[k]];
                return `door ${words.visible(d.name)} ${r.col("doors.closed")[k] ? "closes" : "opens"}`;
            }
            case state: return `${name(who)} ${state_words[r.col("states.what")[k]]}`;
            case loss: return `${name(who)} loses ${packet || "a frame"}: ${r.head.drops[r.col("drops.reason")[k]]?.text ?? "lost"}`;
            case frame: return `${name(who)} \u2192 ${name(other)}: ${packet || r.head.frame_kinds[block.kind[k]]}`;
            default: return `${name(who)} \u2190 ${name(other)}: ${packet || r.head.frame_kinds[block.kind[w.flight[i]]]}, ${signs.kinds[sign].text}`;
        }
    }

    return { kind_names, window_of, filtered, about, text, frame };
})();

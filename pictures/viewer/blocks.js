// SPDX-License-Identifier: MIT
// Frames and their receptions: blocks that are unpacked when they are needed.
/** @typedef {"start"|"airtime"|"sender"|"to"|"message"|"kind"|"ttl"|"hops"|"queue"|"robot"|"outcome"} BlockColumn */
/** @typedef {Record<BlockColumn, Numbers> & {number: number, first: Uint32Array, flights: number, longest: number, end: (flight: number) => number}} Block */
/** @typedef {InstanceType<typeof blocks.Blocks>} Blocks */
const blocks = (() => {
    "use strict";
    const most_kept = 8, small = 16384, most_grown = 2e7;  // blocks, receptions

    const of_flights = ["start", "airtime", "sender", "to", "message", "kind", "ttl", "hops"], of_receptions = ["robot", "outcome"];
    const queue = "queue";  // of flights, not in every run

    /** Frames of a part of the run, in order of their start. Frame i has the receptions first[i] to first[i + 1]. @param {number} number @param {(name: string) => Numbers} column @param {Uint32Array} first @returns {Block} */
    function block_of(number, column, first) {
        const columns = /** @type {Record<BlockColumn, Numbers>} */ (Object.fromEntries([...of_flights, queue, ...of_receptions].map(name => [name, column(name)])));
        const { start, airtime } = columns;
        let longest = 0;
        for (const time of airtime) if (time > longest) longest = time;
        return { ...columns, number, first, flights: start.length, longest, end: flight => start[flight] + airtime[flight] };
    }

    /** @param {Run} r @param {number} number */
    async function read(r, number) {
        /** @type {Map<string, Numbers>} */ const columns = new Map(), none = new Uint8Array(0);
        /** @param {string} part @param {string[]} names */
        const get = (part, names) => Promise.all(names.map(async name => columns.set(name, await rvw.column(r.file, `${number}/${part}.${name}`))));
        const there = [...of_flights, "count", ...r.file.sections.has(`${number}/flights.${queue}`) ? [queue] : []];
        await Promise.all([get("flights", there), get("receptions", of_receptions)]);
        const count = columns.get("count") ?? none, flights = count.length, first = new Uint32Array(flights + 1);
        if (there.some(name => columns.get(name)?.length !== flights)) rvw.broken(`${number}/flights`);
        for (let i = 0; i < flights; i++) first[i + 1] = first[i] + count[i];
        if (of_receptions.some(name => columns.get(name)?.length !== first[flights])) {
            rvw.broken(`${number}/receptions`);
        }
        const block = block_of(number, name => columns.get(name) ?? none, first);
        run.check_below(block.sender, r.robots, "flights.sender");
        run.check_below(block.kind, r.head.frame_kinds.length, "flights.kind");
        run.check_below(block.robot, r.robots, "receptions.robot");
        run.check_below(block.outcome, head_check.outcomes, "receptions.outcome");
        return block;
    }

    /** Block with the frames of another one behind its own. @param {Block} one @param {Block} more */
    function joined(one, more) {
        const n = one.robot.length, first = new Uint32Array(one.first.length + more.flights);
        first.set(one.first);
        for (let i = 1; i <= more.flights; i++) first[one.flights + i] = n + more.first[i];
        return block_of(one.number, name => {
            const a = one[/** @type {BlockColumn} */ (name)], b = more[/** @type {BlockColumn} */ (name)], out = new (/** @type {any} */ (b.constructor))(a.length + b.length);
            out.set(a);
            out.set(b, a.length);
            return out;
        }, first);
    }

    /** The blocks of a run; the last ones used are kept. */
    class Blocks {
        /** @param {Run} r */
        constructor(r) {
            this.run = r;
            this.info = r.head.blocks;
            /** @type {Map<number, Block>} */ this.kept = new Map();
            /** @type {Map<number, Promise<Block>>} */ this.coming = new Map();
            /** Kinds of frames that were met. @type {Set<number>} */ this.kinds = new Set();
            /** Called when a block has come. @type {() => void} */ this.arrived = () => {};
            /** @type {(error: Error) => void} */ this.failed = () => {};
            /** Counts every block that has come. */ this.version = 0;
            /** Receptions of a run that goes on, all of which are here. */ this.grown = 0;
            /** Begin of each block. @type {number[]} */ this.begins = this.info.map(info => info.begin_ns);
            /** Latest end of the blocks up to each. @type {number[]} */
            this.until = [];
            for (const info of this.info) this.until.push(Math.max(info.end_ns, this.until.at(-1) ?? 0));
            /** Whether frames of the run are left out. */ this.cut = this.info.reduce((n, info) => n + info.flights, 0) < r.head.counts.flights;
        }

        /** @param {number} number @returns {Promise<Block>} */
        load(number) {
            const there = this.kept.get(number);
            if (there) {
                this.kept.delete(number);
                this.kept.set(number, there);
                return Promise.resolve(there);
            }
            const coming = this.coming.get(number) ?? read(this.run, number).then(block => {
                this.keep(number, block);
                const oldest = this.kept.keys().next().value;
                if (this.kept.size > most_kept && oldest !== undefined) this.kept.delete(oldest);
                return block;
            }).finally(() => this.coming.delete(number));
            this.coming.set(number, coming);
            return coming;
        }

        /** @param {number} number @param {Block} block */
        keep(number, block) {
            this.kept.set(number, block);
            this.version++;
            for (const kind of block.kind) this.kinds.add(kind);
        }

        /** Adds the next frames of a run that goes on. The oldest ones go when there are too many. @param {Block} block */
        append(block) {
            let number = this.info.length;
            const last = this.kept.get(number - 1);
            if (last && last.robot.length + block.robot.length <= small) {
                block = joined(last, block);
                number--;
            }
            block.number = number;
            let end = 0;
            for (let i = 0; i < block.flights; i++) end = Math.max(end, block.end(i));
            this.begins[number] = block.start[0] ?? 0;
            this.info[number] = { begin_ns: this.begins[number], end_ns: end, flights: block.flights, receptions: block.robot.length };
            this.until[number] = Math.max(end, this.until[number - 1] ?? 0);
            this.keep(number, block);
            this.grown += block.robot.length - (last?.number === number ? last.robot.length : 0);
            for (let n = 0; this.grown > most_grown && n < number; n++) {
                this.grown -= this.kept.get(n)?.robot.length ?? 0;
                this.kept.set(n, block_of(n, () => new Uint8Array(0), new Uint32Array(1)));
            }
        }

        /** A block, if it is there; else it is on its way. @param {number} number @returns {Block|undefined} */
        get(number) {
            const there = this.kept.get(number);
            if (!there && !this.coming.has(number)) this.load(number).then(() => this.arrived(), error => this.failed(error));
            return there;
        }

        /** Block whose frames a time is among. @param {number} t */
        at(t) {
            return Math.max(0, run.count_until(this.begins, t) - 1);
        }

        /** Queue of a robot when it last began to send, and that time. Searched in the block of the time, if it is there, and in the one before. @param {number} robot @param {number} t */
        queue(robot, t) {
            for (let n = this.at(t), last = Math.max(0, n - 1); n >= last; n--) {
                const block = this.info[n] && this.get(n);
                if (!block || !block.queue.length) return null;
                for (let i = run.count_until(block.start, t) - 1; i >= 0; i--) {
                    if (block.sender[i] === robot) return { frames: block.queue[i], since: block.start[i] };
                }
            }
            return null;
        }

        /** Visits the frames on air between two times; true if all blocks were there. @param {number} from @param {number} to @param {(block: Block, flight: number) => boolean|void} visit returns false to stop */
        between(from, to, visit) {
            let whole = true;
            for (let n = this.at(to); n >= 0 && this.until[n] >= from; n--) {
                if (!this.info[n]) break;
                const block = this.get(n);
                whole = whole && block !== undefined;
                if (!block) continue;
                for (let i = run.count_until(block.start, from - block.longest - 1); i < block.flights && block.start[i] <= to; i++) {
                    if (block.end(i) >= from && visit(block, i) === false) return whole;
                }
            }
            return whole;
        }
    }

    return { Blocks, read };
})();

// SPDX-License-Identifier: MIT
// Run as data: places and states of robots and doors at any time.
/** @typedef {{x: number, y: number, z: number, vx: number, vy: number, heading: number}} Pose */
/** @typedef {Record<"first"|"start"|"end"|"x"|"y"|"vx"|"vy"|"heading"|"turning", Numbers> & {z?: Numbers, vz?: Numbers}} Legs */
/** @typedef {InstanceType<typeof run.Run>} Run */
const run = (() => {
    "use strict";

    const nanoseconds = 1e9;
    /** Height above which a robot counts to the storey above [m] below its floor. */
    const floor_slack = 0.01;

    /** Number of values at or before v in a sorted column. @param {Numbers|number[]} sorted @param {number} v @param {number} low @param {number} high */
    function count_until(sorted, v, low = 0, high = sorted.length) {
        while (low < high) {
            const middle = (low + high) >>> 1;
            if (sorted[middle] <= v) low = middle + 1; else high = middle;
        }
        return low;
    }

    /** @param {Numbers} column @param {number} below @param {string} what */
    function check_below(column, below, what) {
        for (let i = 0; i < column.length; i++) {
            if (column[i] >= below) rvw.broken(what);
        }
    }

    /** Columns of each part of the run; those behind a bar need not be there. @type {Record<string, string>} */
    const columns_of = {
        walls: "x y material storey", legs: "first start end x y vx vy heading turning|z vz", states: "time robot what", doors: "time door closed",
        messages: "uid created origin to size flow kind|frames block", drops: "time robot message reason", links: "|time from to up"
    };
    const [needed, optional] = [0, 1].map(i => Object.entries(columns_of).flatMap(([part, names]) => (names.split("|")[i] || "").split(" ").filter(Boolean).map(name => `${part}.${name}`)));

    /** Names of the columns of a part of the run. @param {string} part */
    function names_of(part) { return [...needed, ...optional].filter(name => name.startsWith(part + ".")); }

    class Run {
        /** @param {ViewFile} file @param {Record<string, Numbers>} columns @param {(i: number) => string} payload */
        constructor(file, columns, payload) {
            this.file = file;
            this.head = file.head;
            this.columns = columns;
            this.robots = file.head.robots.length;
            this.nobody = this.robots < 65535 ? 65535 : 4294967295;
            this.messages = this.col("messages.uid").length;
            this.duration = file.head.duration_ns;
            /** Columns of the legs; z and vz only if there are storeys. @type {Legs} */
            this.legs = /** @type {any} */ (Object.fromEntries(names_of("legs").map(name => [name.slice(5), columns[name]])));
            /** Last leg asked for of each robot, from its first. */
            this.hint = new Uint32Array(this.robots);
            /** @type {Map<number, {at: number, what: number}[]>} */ this.states = new Map();
            this.add_states(0);
            /** @type {Map<number, number>} */ this.by_uid = new Map();
            /** Number of the first message of each part, and the payloads of the part. */
            this.payloads = { first: /** @type {number[]} */ ([]), of: /** @type {((i: number) => string)[]} */ ([]) };
            this.add_messages(0, payload);
        }

        /** @param {string} name @returns {Numbers} */
        col(name) {
            return this.columns[name] ?? rvw.broken(name);
        }

        /** Sorts changes of states by robot. @param {number} from number of the first one */
        add_states(from) {
            const robot = this.col("states.robot"), what = this.col("states.what"), time = this.col("states.time");
            for (let i = from; i < robot.length; i++) {
                const of_robot = this.states.get(robot[i]) ?? [];
                of_robot.push({ at: time[i], what: what[i] });
                this.states.set(robot[i], of_robot);
            }
        }

        /** Makes messages known. @param {number} from number of the first one @param {(i: number) => string} payload of each, counted from that one */
        add_messages(from, payload) {
            const uid = this.col("messages.uid");
            this.messages = uid.length;
            for (let i = from; i < uid.length; i++) this.by_uid.set(uid[i], i);
            this.payloads.first.push(from);
            this.payloads.of.push(payload);
        }

        /** Begin of the content of a message. @param {number} message */
        payload(message) {
            const part = Math.max(0, count_until(this.payloads.first, message) - 1);
            return this.payloads.of[part]?.(message - this.payloads.first[part]) ?? "";
        }

        /** Index of the leg of a robot at a time. @param {number} robot @param {number} t */
        leg(robot, t) {
            const { first, start } = this.legs;
            const low = first[robot], high = first[robot + 1];
            let leg = low + this.hint[robot];
            const fits = leg < high && start[leg] <= t && (leg + 1 >= high || start[leg + 1] > t);
            if (!fits) leg = Math.max(low, count_until(start, t, low, high) - 1);
            this.hint[robot] = leg - low;
            return leg;
        }

        /** Place of a robot at a time [ns]. @param {number} robot @param {number} t @param {Pose} [out] */
        pose(robot, t, out = { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 }) {
            const legs = this.legs, leg = this.leg(robot, t);
            const start = legs.start[leg], end = legs.end[leg];
            const passed = Math.max(0, Math.min(t, end) - start) / nanoseconds;
            const moves = t >= start && t < end;
            out.x = legs.x[leg] + legs.vx[leg] * passed;
            out.y = legs.y[leg] + legs.vy[leg] * passed;
            out.z = legs.z && legs.vz ? legs.z[leg] + legs.vz[leg] * passed : 0;
            out.heading = legs.heading[leg] + legs.turning[leg] * passed;
            out.vx = moves ? legs.vx[leg] : 0;
            out.vy = moves ? legs.vy[leg] : 0;
            return out;
        }

        /** What became of a robot until a time: an arrival counts until it drives on. @param {number} robot @param {number} t */
        state(robot, t) {
            const { start, end, vx, vy } = this.legs, leg = this.leg(robot, t);
            let what = 1, word = 0, since = 0;
            for (const change of this.states.get(robot) ?? []) {
                if (change.at > t) break;
                if (change.what === 2 || change.what === 3) [word, since] = [change.what, change.at]; else what = change.what;
            }
            if (start[leg] > since || t < end[leg] && (vx[leg] || vy[leg])) word = 0;
            return { on: what === 1, there: what < 4, word: ["", "", "arrived", "found no way", "not departed", "left"][what < 4 ? word : what] };
        }

        /** @param {number} z */
        storey(z) {
            const floors = this.head.map.floors;
            let n = 0;
            while (n + 1 < floors.length && floors[n + 1] <= z + floor_slack) n++;
            return n;
        }

        /** Which doors are closed at a time. @param {number} t @returns {boolean[]} */
        doors(t) {
            const closed = this.head.map.doors.map(door => Boolean(door.closed));
            const time = this.col("doors.time"), until = count_until(time, t);
            for (let i = 0; i < until; i++) closed[this.col("doors.door")[i]] = this.col("doors.closed")[i] === 1;
            return closed;
        }

        /** @param {number} robot */
        name(robot) { return this.head.robots[robot]?.name ?? "nobody"; }

        /** Name of a robot as it is shown. @param {number} robot @param {number} [most] */
        label(robot, most = 24) { return words.short(this.name(robot), most); }

        /** Name of a message as people say it. @param {number} message */
        message_text(message) {
            if (message >= this.messages) return "";
            const kind = this.head.message_kinds[this.col("messages.kind")[message]];
            return kind ? `${kind} ${this.col("messages.uid")[message]}` : `message ${this.col("messages.uid")[message]}`;
        }
    }

    /** @param {Run} r */
    function check(r) {
        for (const part of ["legs", "states", "doors", "messages", "drops", "links"]) {
            const there = names_of(part).filter(name => name !== "legs.first" && r.columns[name]);
            for (const name of there) if (r.col(name).length !== r.col(there[0]).length) rvw.broken(name);
        }
        const walls = r.col("walls.material").length;
        if (r.col("walls.x").length !== 4 * walls || r.col("walls.y").length !== 4 * walls || r.col("walls.storey").length !== walls) {
            rvw.broken("walls");
        }
        const first = r.col("legs.first"), legs = r.col("legs.x").length;
        if (first.length !== r.robots + 1) rvw.broken("legs.first");
        for (let i = 0; i < r.robots; i++) {
            if (first[i] >= first[i + 1] || first[i + 1] > legs) rvw.broken("legs.first");
        }
        /** @type {[string, number][]} */
        const limits = [["walls.material", r.head.map.materials.length], ["states.robot", r.robots], ["states.what", 6], ["doors.door", r.head.map.doors.length], ["messages.origin", r.robots],
            ["messages.kind", r.head.message_kinds.length], ["messages.flow", r.head.flows.length], ["links.from", r.robots], ["links.to", r.robots], ["drops.robot", r.robots]];
        for (const [name, below] of limits) check_below(r.columns[name] ?? [], below, name);
        for (const { message, robot } of r.head.follow) {
            if (message >= r.messages || robot >= r.robots) rvw.broken("follow");
        }
    }

    /** @param {ViewFile} file @returns {Promise<Run>} */
    async function load(file) {
        /** @type {Record<string, Numbers>} */
        const columns = {};
        for (const name of needed) columns[name] = await rvw.column(file, name);
        for (const name of optional) if (file.sections.has(name)) columns[name] = await rvw.column(file, name);
        for (let level = 0; level < file.head.density.length; level++) {
            const name = `density.${level}`;
            columns[name] = await rvw.column(file, name, "u32");
            if (file.head.live && columns[name].length === 0) columns[name] = new Uint32Array(file.head.density[level].bins * head_check.outcomes);
            if (columns[name].length !== file.head.density[level].bins * head_check.outcomes) {
                rvw.broken(name);
            }
        }
        for (let i = 0; i < file.head.series.length; i++) {
            const name = `series.${i}`;
            columns[name] = await rvw.column(file, name, "f64");
            if (columns[name].length !== file.head.series[i].points || columns[name].length === 0) rvw.broken(name);
        }
        const out = new Run(file, columns, await rvw.texts(file, "messages.payload"));
        check(out);
        return out;
    }

    return { Run, load, names_of, count_until, check_below, nanoseconds };
})();

// SPDX-License-Identifier: MIT
// A run that goes on: puts what came later behind what is there.
const growth = (() => {
    "use strict";
    const plain = ["states", "links", "messages", "drops"].flatMap(run.names_of);

    /** Column with more numbers behind it, in the same memory if there is room. @param {Numbers} column @param {Numbers} more @returns {Numbers} */
    function longer(column, more) {
        if (more.length === 0) return column;
        const type = /** @type {any} */ (column.constructor), length = column.length + more.length;
        let memory = column.buffer;
        if (column.byteOffset > 0 || memory.byteLength < length * column.BYTES_PER_ELEMENT) {
            const room = new type(2 * length);
            room.set(column);
            memory = room.buffer;
        }
        const out = new type(memory, 0, length);
        out.set(more, column.length);
        return out;
    }

    /** Legs of each robot, the later ones behind the earlier ones. @param {Run} r @param {Record<string, Numbers>} more */
    function add_legs(r, more) {
        const added = more["legs.first"];
        if (!added || added[r.robots] === 0) return;
        if (added.length !== r.robots + 1) rvw.broken("legs.first");
        const before = r.legs.first, first = new Uint32Array(r.robots + 1);
        for (let i = 0; i <= r.robots; i++) first[i] = before[i] + added[i];
        /** @type {number[]} */ const moved = [];
        for (let i = 0; i < r.robots; i++) if (added[i + 1] > added[i]) moved.push(i);
        /** @param {Numbers} old @param {Numbers|undefined} some */
        const merged = (old, some) => {
            const out = new (/** @type {any} */ (old.constructor))(first[r.robots]);
            let from = 0;
            for (const i of moved) {
                out.set(old.subarray(from, before[i + 1]), from + added[i]);
                if (some) out.set(some.subarray(added[i], added[i + 1]), before[i + 1] + added[i]);
                from = before[i + 1];
            }
            out.set(old.subarray(from), from + added[r.robots]);
            return out;
        };
        /** @type {any} */ const legs = r.legs;
        for (const column of run.names_of("legs").slice(1)) {  // but legs.first
            const name = column.slice(5);
            if (!legs[name] && more[column]) legs[name] = new Float64Array(before[r.robots]);
            if (legs[name]) legs[name] = merged(legs[name], more[column]);
        }
        legs.first = first;
    }

    /** @param {Run} r @param {Head} head of the part @param {Record<string, Numbers>} more */
    function add_counts(r, head, more) {
        const { counts } = head;
        if (!counts) return;
        for (const key of /** @type {const} */ (["flights", "receptions", "messages"])) r.head.counts[key] += counts[key];
        counts.outcomes.forEach((n, i) => r.head.counts.outcomes[i] += n);
        head.density.forEach(({ begin = 0 }, level) => {
            const all = r.col(`density.${level}`), some = more[`density.${level}`] ?? [], from = begin * head_check.outcomes;
            if (from + some.length > all.length) rvw.broken("density");
            for (let i = 0; i < some.length; i++) all[from + i] += some[i];
        });
        r.head.drops = head.drops;
        r.head.frame_kinds = head.frame_kinds;
        r.head.message_kinds = head.message_kinds;
    }

    /** Adds a part to a run. @param {Run} r @param {Blocks} all @param {ViewFile} file */
    async function add(r, all, file) {
        /** @type {Record<string, Numbers>} */ const more = {};
        for (const name of file.sections.keys()) {
            if (!name.includes("/") && name !== "messages.payload") more[name] = await rvw.column(file, name);
        }
        const payload = file.sections.has("messages.payload") ? await rvw.texts(file, "messages.payload") : null;
        const block = file.head.blocks?.length ? await blocks.read(/** @type {any} */ ({ ...r, file }), 0) : null;
        add_counts(r, file.head, more);
        add_legs(r, more);
        const known = r.messages, states = r.col("states.time").length;
        for (const name of plain) if (more[name]) r.columns[name] = longer(r.columns[name] ?? new (/** @type {any} */ (more[name].constructor))(0), more[name]);
        r.add_states(states);
        if (payload) r.add_messages(known, payload);
        if (block) all.append(block);
    }

    return { add };
})();

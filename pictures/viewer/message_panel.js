// SPDX-License-Identifier: MIT
// Way of a message in words and on the map, and why robots do not have it.
const message_panel = (() => {
    "use strict";
    const most_rows = 300;
    /** @type {{run: Run, blocks: Blocks, flood: Flood|null, wanted: number, changes: number, told: string, done: () => void}} */
    const own = { run: /** @type {any} */ (null), blocks: /** @type {any} */ (null), flood: null, wanted: -1, changes: 0, told: "", done: () => {} };

    /** @param {number} robot */
    function robot_button(robot) {
        return dom.button(own.run.label(robot), "link", () => selection.choose(robot));
    }

    /** Why a robot does not have the message, as far as the page knows. @param {Flood} flood @param {number} robot */
    function reason(flood, robot) {
        const told = own.run.head.follow.find(a => a.message === flood.message && a.robot === robot);
        if (told) return told.text;
        const lost = flood.lost.get(robot) ?? [];
        if (lost.length === 0) return `No frame of it reached this robot${flood.left_out ? " in the part that is shown" : ""}.`;
        const parts = lost.slice(0, 3).map(copy => `${signs.kinds[copy.sign].text} at ${words.seconds(copy.at)} s, from ${words.visible(own.run.name(copy.from))}`);
        return parts.join("; ") + (lost.length > 3 ? `; and ${lost.length - 3} more` : "") + ".";
    }

    /** Sentence without the robot's name, which stands before it. @param {string} sentence @param {number} robot */
    function after_name(sentence, robot) {
        const name = `${own.run.name(robot)} `;
        return sentence.startsWith(name) ? sentence.slice(name.length) : sentence;
    }

    /** Row of a robot without the message, with a button that asks. @param {Flood} flood @param {number} robot */
    function without(flood, robot) {
        const key = floods.outcome(own.run, flood, robot), number = signs.kinds.findIndex(k => k.key === key);
        const text = dom.make("span", "", after_name(reason(flood, robot), robot)), line = dom.make("span", "", robot_button(robot), " ", text, " ");
        const out = dom.make("li", "", ...(number >= 0 ? [dom.sign(number)] : []), line);
        if (!server.is_served()) return out;
        line.append(dom.button("why?", "small", () => {
            text.textContent = "\u2026";
            sides.ask("why", { uid: own.run.col("messages.uid")[flood.message], robot }).then(answer => {
                text.textContent = after_name(answer.answer, robot);
                if (answer.frames.length) out.after(dom.make("li", "wide", tables.of(answer.frames)));
                line.querySelector(".small")?.remove();
            }, error => text.textContent = error.message);
        }, `why ${own.run.name(robot)} does not have it`));
        return out;
    }

    /** Who had it from this robot. @param {Flood} flood @param {Map<number, number[]>} children @param {number} robot @param {{left: number, seen: Set<number>}} budget */
    function branch(flood, children, robot, budget) {
        const out = dom.make("ul", "");
        for (const child of children.get(robot) ?? []) {
            if (budget.left-- <= 0 || budget.seen.has(child)) break;
            budget.seen.add(child);
            const copy = /** @type {Copy} */ (flood.first.get(child));
            const after = words.span(copy.at - own.run.col("messages.created")[flood.message]);
            const line = dom.make("li", "", dom.sign(copy.sign), robot_button(child), dom.make("span", "muted", ` after ${after}`));
            if (children.has(child)) line.append(branch(flood, children, child, budget));
            out.append(line);
        }
        return out;
    }

    /** @param {number} message */
    function facts(message) {
        const r = own.run, to = r.col("messages.to")[message], payload = words.visible(r.payload(message));
        /** @type {[string, Node|string][]} */
        const rows = [
            ["from", robot_button(r.col("messages.origin")[message])],
            ["to", to < r.robots ? robot_button(to) : "everybody"],
            ["sent at", dom.button(`${words.seconds(r.col("messages.created")[message], 9)} s`, "link", () => clock.seek(r.col("messages.created")[message]))],
            ["size", words.counted(r.col("messages.size")[message], "byte")]
        ];
        if (payload) rows.push(["payload", dom.make("code", "", payload)]);
        const flow = r.head.flows[r.col("messages.flow")[message]];
        if (flow) rows.push(["flow", words.visible(flow)]);
        return dom.facts(rows);
    }

    /** Tells of a way, unless all of it is told: answers and the focus stay where they are. @param {Flood} flood */
    function tell(flood) {
        const key = [flood.message, flood.frames, flood.first.size, flood.whole].join(" ");
        if (key === own.told) return;
        own.told = key;
        const r = own.run, message = flood.message, wanted = floods.wanted(r, message);
        const missing = wanted.filter(robot => !flood.first.has(robot));
        /** @type {Map<number, number[]>} */ const children = new Map();
        for (const [robot, copy] of [...flood.first].sort((a, b) => a[1].at - b[1].at)) {
            const list = children.get(copy.from) ?? [];
            list.push(robot);
            children.set(copy.from, list);
        }
        const origin = r.col("messages.origin")[message], budget = { left: most_rows, seen: new Set([origin]) };
        const whole = flood.whole && !(live.state()?.left_out && r.col("messages.created")[message] < own.blocks.begins[0]);
        const parts = [dom.make("h2", "", r.message_text(message)), facts(message),
            dom.make("p", "", `${wanted.length - missing.length} of ${words.counted(wanted.length, "robot")} got it, after ${words.counted(flood.frames, "frame")}` +
                (whole ? "." : ", in the part that was read.") + (flood.left_out ? ` Left out: ${words.counted(flood.left_out, "frame")} of it.` : ""))];
        if (flood.first.size) parts.push(dom.make("h3", "", "Who got it from whom"), dom.make("div", "tree", robot_button(origin), branch(flood, children, origin, budget)));
        if (budget.left < 0) parts.push(dom.make("p", "muted", `The first ${most_rows} are shown.`));
        if (missing.length) {
            parts.push(dom.make("h3", "", `Without it: ${words.counted(missing.length, "robot")}`), dom.make("ul", "plain", ...missing.slice(0, most_rows).map(robot => without(flood, robot))));
        }
        parts.push(dom.make("p", "actions", dom.button("its events", "", () => selection.set({ filter: { ...selection.state.filter, message }, panel: "events" })),
            dom.button("leave", "", () => selection.set({ message: -1 }))));
        dom.by_id("message-panel").replaceChildren(...parts);
    }

    /** @param {State} state */
    function update(state) {
        if (state.message === own.wanted) return;
        own.wanted = state.message;
        if (own.flood?.message !== state.message) own.flood = null;
        own.changes++;
        if (own.flood === null) own.told = "";
        if (state.message < 0) {
            dom.by_id("message-panel").replaceChildren(...nothing());
            return;
        }
        floods.of(own.run, own.blocks, state.message).then(flood => {
            if (own.wanted !== flood.message) return;
            own.flood = flood;
            own.changes++;
            tell(flood);
            own.done();
        }, error => dom.by_id("message-panel").replaceChildren(dom.make("p", "", error.message)));
    }

    /** Reads the way of the message again: the run has gone on. */
    function renew() { if (selection.state.panel === "message" || own.wanted >= 0) own.wanted = -2; }

    /** Messages to begin with: those that somebody missed, then the first ones. */
    function nothing() {
        const r = own.run, missed = [...new Set(r.head.follow.map(a => a.message))].slice(0, 20);
        const some = missed.length ? missed : Array.from({ length: Math.min(20, r.messages) }, (_, i) => i);
        if (some.length === 0) return [dom.make("p", "", "No message was sent in this run.")];
        const rows = some.map(message => dom.make("li", "", dom.button(`${r.message_text(message)} of ${r.label(r.col("messages.origin")[message])}`, "link",
            () => selection.set({ message, t: r.col("messages.created")[message] })), dom.make("span", "muted", ` at ${words.seconds(r.col("messages.created")[message], 3)} s`)));
        return [dom.make("p", "", "Choose a message: by a double click on an event, or by its number in the search."),
            dom.make("h3", "", missed.length ? "Messages that somebody missed" : "The first messages"), dom.make("ul", "plain", ...rows)];
    }

    /** Lines of a way on the map: solid what has happened until now. @param {CanvasRenderingContext2D} c @param {Flood|null} flood @param {State} state */
    function draw(c, flood, state) {
        if (!flood) return;
        const { at } = robots, color = theme.colors().accent;
        for (const [robot, copy] of flood.first) {
            if (at.storey[robot] !== state.storey && at.storey[copy.from] !== state.storey) continue;
            const done = copy.at <= state.t;
            pen.take(c, color, done ? 2.4 : 1.6, done ? [] : [2, 4]);
            pen.line(c, at.x[copy.from], at.y[copy.from], at.x[robot], at.y[robot]);
        }
        c.font = `bold ${pen.font(10)}`;
        c.textAlign = "center";
        c.textBaseline = "middle";
        for (const [robot, copy] of flood.first) {
            if (at.storey[robot] !== state.storey || copy.at > state.t || flood.first.size > 200) continue;
            c.fillStyle = color;
            pen.circle(c, at.x[robot] - 12, at.y[robot] + 11, 7);
            c.fill();
            c.fillStyle = theme.colors().paper;
            c.fillText(String(copy.hops), at.x[robot] - 12, at.y[robot] + 11.5);
        }
        c.textAlign = "left";
    }

    /** @param {(width: number, draw: (c: CanvasRenderingContext2D) => void, text: string) => HTMLElement} item */
    function legend(item) {
        if (!own.flood) return [];
        return [item(24, c => {
            pen.take(c, theme.colors().accent, 2.4);
            pen.line(c, 0, 8, 24, 8);
        }, "path of the message, with its hops")];
    }

    /** @param {Run} r @param {Blocks} all */
    function show(r, all) { Object.assign(own, { run: r, blocks: all, flood: null, wanted: -2 }); }

    /** @param {() => void} done called when the way is known */
    function begin(done) { own.done = done; }

    return { begin, show, update, renew, draw, legend, version: () => own.changes, flood: () => own.flood };
})();

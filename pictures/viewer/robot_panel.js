// SPDX-License-Identifier: MIT
// Inspector of a robot: where it is, its radio, what it did, whom it hears.
const robot_panel = (() => {
    "use strict";
    const most_messages = 50;
    /** @type {Pose} */ const pose = { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 };
    /** @type {{run: Run, blocks: Blocks, robot: number, covers: HTMLElement, counts: Uint32Array|null, sent: Uint32Array|null, read: number, messages: string}} */
    const own = { run: /** @type {any} */ (null), blocks: /** @type {any} */ (null), robot: -2, covers: /** @type {any} */ (null), counts: null, sent: null, read: 0, messages: "" };

    /** Counts frames and receptions of all robots, block by block. */
    async function count() {
        if (own.counts) return;
        const n = own.run.robots, counts = own.counts = new Uint32Array(n * signs.count), sent = own.sent = new Uint32Array(n);
        for (own.read = 0; own.read < own.blocks.info.length; own.read++) {
            const block = await own.blocks.load(own.read);
            if (own.counts !== counts) return;
            for (const sender of block.sender) sent[sender]++;
            for (let k = 0; k < block.robot.length; k++) counts[block.robot[k] * signs.count + signs.of(block.outcome[k])]++;
        }
        own.robot = -2;
        update(selection.state);
    }

    /** @param {number} robot @param {State} state @returns {[string, Node|string][]} */
    function place(robot, state) {
        const r = own.run, { on, there, word } = r.state(robot, state.t);
        r.pose(robot, state.t, pose);
        const speed = Math.hypot(pose.vx, pose.vy), degrees = ((pose.heading * 180 / Math.PI) % 360 + 360) % 360;
        const out = /** @type {[string, Node|string][]} */ ([
            ["place", [pose.x, pose.y, ...(r.legs.z ? [pose.z] : [])].map(v => `${words.fixed(v, 2)} m`).join(", ")],
            ["heading", `${degrees.toFixed(0)}\u00b0`],
            ["speed", `${speed.toFixed(2)} m/s`],
            ["state", [there && (on ? "on" : "off"), word].filter(Boolean).join(", ")]
        ]);
        const queue = on && own.blocks.queue(robot, state.t);
        if (queue) out.push(["queue", `${words.counted(queue.frames, "frame")}${queue.frames < 255 ? "" : " or more"}, as it sent at ${words.seconds(queue.since, 6)} s`]);
        if (r.head.map.floors.length > 1) out.splice(1, 0, ["storey", `${r.storey(pose.z) + 1} of ${r.head.map.floors.length}`]);
        return out;
    }

    /** @param {number} robot @returns {[string, Node|string][]} */
    function radio(robot) {
        const { model, power_dbm, sensitivity_dbm, antenna_z } = own.run.head.robots[robot];
        /** @type {[string, Node|string][]} */ const out = [["model", words.visible(String(model))]];
        if (typeof power_dbm === "number") out.push(["power", `${words.number(power_dbm, 4)} dBm`]);
        if (typeof sensitivity_dbm === "number") out.push(["sensitivity", `${words.number(sensitivity_dbm, 4)} dBm`]);
        if (typeof antenna_z === "number") out.push(["antenna", `${words.number(antenna_z, 3)} m up`]);
        return out;
    }

    /** @param {number} robot @returns {HTMLElement} */
    function counters(robot) {
        const { counts, sent } = own;
        if (!counts || !sent) return dom.make("p", "muted", "counting \u2026");
        if (own.read < own.blocks.info.length) return dom.make("p", "muted", `counting, part ${own.read + 1} of ${own.blocks.info.length} \u2026`);
        const rows = signs.kinds.map((kind, sign) => ({ kind, sign, n: counts[robot * signs.count + sign] })).filter(row => row.n > 0);
        return dom.make("ul", "plain", dom.make("li", "", dom.make("span", "icon", "\u2197"), `${words.counted(sent[robot], "frame")} sent`),
            ...rows.map(({ kind, sign, n }) => dom.make("li", "", dom.sign(sign), `${words.count(n)} ${kind.text}`)));
    }

    /** Messages that this robot sent or got until now, the last first. @param {number} robot @param {number} t @returns {number[]} */
    function recent(robot, t) {
        const out = new Set();
        for (let w = list.own.window, n = 2; w && n > 0 && out.size < most_messages; w = list.before(w), n--) {
            for (let i = run.count_until(w.time, t) - 1; i >= 0 && out.size < most_messages; i--) {
                const { who, message } = events.about(own.run, w, i);
                if (who === robot && message >= 0 && message < own.run.messages) out.add(message);
            }
        }
        return [...out];
    }

    /** @param {number} robot @param {State} state */
    function messages(robot, state) {
        const some = recent(robot, state.t), key = `${robot} ${some.join(" ")}`;
        if (key === own.messages) return;
        own.messages = key;
        const r = own.run, rows = some.map(message => dom.make("li", "",
            dom.button(r.message_text(message), "link", () => selection.set({ message, panel: "message" })),
            dom.make("span", "muted", ` of ${r.label(r.col("messages.origin")[message], 20)}, ${words.seconds(r.col("messages.created")[message], 3)} s`)));
        dom.by_id("robot-messages").replaceChildren(...(rows.length ? rows : [dom.make("li", "muted", "none in this part of the run")]));
    }

    /** The air at a robot in the last second, as the server tells it. @param {Record<string, any>} air @returns {[string, Node|string][]} */
    function facts_of_air(air) {
        /** @param {number} share */
        const percent = share => typeof share === "number" ? `${words.number(100 * share, 3)}\u2009%` : "\u2013";
        const senders = air.senders.map((/** @type {any} */ one) => `${words.short(one.robot, 16)} ${percent(one.share)}`);
        return [["busy", `${percent(air.busy)} of ${words.span((air.to_s - air.from_s) * run.nanoseconds)}`],
            ["its own", `${percent(air.sending)}, ${words.counted(air.frames_sent, "frame")}`],
            ["of others", [words.counted(air.frames_heard, "frame"), ...senders].join(", ")]];
    }

    /** Heading with a button that asks the server, and the place of the answer. @param {string} title @param {string} id @param {string} op @param {number} robot @param {(answer: any) => Node} shown */
    function asked(title, id, op, robot, shown) {
        const heading = dom.make("h3", "", title), place = dom.make("div", "", dom.make("p", "muted", server.is_served() ? "the answer is for the time shown" : server.how));
        place.id = id;
        if (server.is_served()) heading.append(" ", dom.button("ask", "small", () => {
            place.textContent = "\u2026";
            sides.ask(op, { robot, t_ns: selection.state.t }).then(answer => place.replaceChildren(shown(answer)), error => place.textContent = error.message);
        }, `ask for ${title.toLowerCase()}`));
        return [heading, place];
    }

    /** @param {any} answer */
    function neighbours(answer) {
        return answer.links.length ? tables.of(answer.links, ["robot", "level_dbm", "margin_db", "noise_dbm", "quality"]) : dom.make("p", "muted", "it hears nobody");
    }

    /** @param {number} robot */
    function build(robot) {
        const place = dom.make("div", "facts-place"), found = dom.make("ul", "plain");
        place.id = "robot-place";
        found.id = "robot-messages";
        const actions = dom.make("p", "actions", dom.button("its events", "", () => selection.set({ filter: { ...selection.state.filter, robot }, panel: "events" })),
            own.covers = dom.button("coverage", "", () => coverage.toggle(robot)));
        if (server.is_served()) actions.append(coverage.choice());
        dom.by_id("robot-panel").replaceChildren(dom.make("h2", "", own.run.label(robot, 60)), place, actions,
            ...drive.parts(robot), dom.make("h3", "", live.is_live() ? "Until now" : own.blocks.cut ? "In the part that is shown" : "In the whole run"), counters(robot),
            dom.make("h3", "", "Radio"), dom.facts(radio(robot)), ...asked("Neighbours", "robot-neighbours", "robot", robot, neighbours),
            ...asked("Air", "robot-air", "air", robot, answer => dom.facts(facts_of_air(answer))),
            dom.make("h3", "", `Last messages until now`), found);
        own.messages = "";
    }

    /** @param {State} state */
    function update(state) {
        const robot = state.robots.at(-1) ?? -1;
        if (state.panel !== "robot") return;
        if (robot !== own.robot) {
            own.robot = robot;
            if (robot < 0) {
                dom.by_id("robot-panel").replaceChildren(dom.make("p", "", "Choose a robot: by a click on the map, or by search."));
                return;
            }
            build(robot);
            count();
        }
        if (robot < 0) return;
        own.covers.setAttribute("aria-pressed", String(coverage.shown() === robot));
        dom.by_id("robot-place").replaceChildren(dom.facts(place(robot, state)));
        messages(robot, state);
    }

    /** Counts again: the run has gone on. */
    function renew() {
        if (own.robot < 0 || selection.state.panel !== "robot" || dom.by_id("robot-panel").contains(document.activeElement)) return;
        own.counts = null;
        count();
    }

    /** @param {Run} r @param {Blocks} all */
    function show(r, all) { Object.assign(own, { run: r, blocks: all, robot: -2, counts: null }); }

    return { show, update, renew };
})();

// SPDX-License-Identifier: MIT
// Budget of the link between two robots, wall by wall; the walls of the way are lit on the map.
/** @typedef {{entry_m: number, exit_m: number, material: string, loss_db: number}} Crossing */
/** @typedef {{from: string, to: string, distance_m: number, up: boolean, walls?: Crossing[]}} Link */
const pair_panel = (() => {
    "use strict";
    /** @type {{run: Run, pair: string, links: Link[][], losses: {text: string, x: number, y: number}[], robots: number[], t: number, done: () => void}} */
    const own = { run: /** @type {any} */ (null), pair: "?", links: [], losses: [], robots: [], t: 0, done: () => {} };
    /** Keys of a link that have a place of their own. */
    const told = ["from", "to", "walls", "id"];

    /** @param {Link} link */
    function one(link) {
        const rows = /** @type {[string, string][]} */ (Object.entries(link).filter(([key, value]) => !told.includes(key) && (typeof value !== "object" || value === null))
            .map(([key, value]) => [tables.title(key), tables.text(value)]));
        const out = [dom.make("h3", "", `${words.visible(String(link.from))} \u2192 ${words.visible(String(link.to))}`), dom.facts(rows)];
        if (link.walls?.length) out.push(tables.of(link.walls, ["material", "entry_m", "length_m", "loss_db"]));
        return out;
    }

    /** @param {number} a @param {number} b */
    function ask(a, b) {
        const place = dom.by_id("pair-answer"), t = selection.state.t;
        place.textContent = "\u2026";
        Promise.all(sides.own.all.map((_, i) => sides.ask("pair", { a, b, t_ns: t }, i))).then(answers => {
            own.links = answers.map(answer => answer.links);
            own.robots = [a, b];
            own.t = answers[0].t_ns ?? t;
            place.replaceChildren(dom.make("p", "muted", `at ${words.seconds(own.t)} s`), ...own.links.flatMap((links, i) => [...(own.links.length > 1 ? [dom.make("h2", "", sides.own.all[i].label)] : []), ...links.flatMap(one)]));
            own.done();
        }, error => place.textContent = error.message);
    }

    /** @param {State} state */
    function update(state) {
        const [a, b] = state.robots, pair = `${a} ${b}`;
        if (state.panel !== "pair" || pair === own.pair) return;
        own.pair = pair;
        own.links = [];
        const panel = dom.by_id("pair-panel");
        if (a === undefined || b === undefined) {
            panel.replaceChildren(dom.make("p", "", "Choose two robots: by Shift and a click on the map, or by search."));
            return;
        }
        const answer = dom.make("div", "");
        answer.id = "pair-answer";
        panel.replaceChildren(dom.make("h2", "", `${own.run.label(a)} and ${own.run.label(b)}`), between(a, b, state.t),
            server.is_served() ? dom.make("p", "actions", dom.button("budget at this time", "", () => ask(a, b))) : dom.make("p", "muted", server.how), answer);
    }

    /** What the page itself knows of two robots. @param {number} a @param {number} b @param {number} t */
    function between(a, b, t) {
        const r = own.run, p = r.pose(a, t), q = r.pose(b, t);
        return dom.facts([["apart", `${Math.hypot(p.x - q.x, p.y - q.y, p.z - q.z).toFixed(2)} m at ${words.seconds(t, 3)} s`]]);
    }

    /** The way from one robot to the other in a run, its walls bold with their loss. @param {CanvasRenderingContext2D} c @param {number} i @param {State} state */
    function draw(c, i, state) {
        const link = own.links[i]?.[0];
        if (!link || state.panel !== "pair") return;
        const { run: r } = sides.own.all[i], [a, b] = own.robots.map(robot => r.pose(robot, own.t));
        const [low, high] = [a, b].map(({ z }, end) => z + r.head.robots[own.robots[end]].antenna_z);  // antennas [m]
        const x0 = camera.to_x(a.x), y0 = camera.to_y(a.y), x1 = camera.to_x(b.x), y1 = camera.to_y(b.y);
        const color = theme.readable(theme.on_scale(signs.look.colors.ember, 0.5));
        /** @param {number} from @param {number} to shares of the way @param {number} width */
        const part = (from, to, width) => {
            pen.take(c, color, width);
            pen.line(c, x0 + from * (x1 - x0), y0 + from * (y1 - y0), x0 + to * (x1 - x0), y0 + to * (y1 - y0));
        };
        part(0, 1, 1.4);
        own.losses = [];
        for (const { entry_m, exit_m, loss_db } of link.walls ?? []) {
            const from = entry_m / link.distance_m, to = exit_m / link.distance_m, middle = (from + to) / 2;
            if (r.storey(low + middle * (high - low)) !== state.storey) continue;
            part(from, to, 7);
            if (loss_db) own.losses.push({ text: `${words.number(loss_db, 3)} dB`, x: x0 + middle * (x1 - x0), y: y0 + middle * (y1 - y0) });
        }
    }

    /** Losses beside their walls, where the names of the robots leave room. @param {CanvasRenderingContext2D} c */
    function tell(c) {
        for (const { text, x, y } of own.losses) {
            pen.label(c, text, 10, theme.colors().ink, width => [[8, -9], [8, 10], [-8 - width, 10], [-8 - width, -9], [8, -24], [-8 - width, 24]].map(([dx, dy]) => [x + dx, y + dy]));
        }
        own.losses = [];
    }

    /** @param {Run} r */
    function show(r) { own.run = r; }

    /** @param {() => void} done */
    function begin(done) { own.done = done; }

    return { begin, show, update, draw, tell };
})();

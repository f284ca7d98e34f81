// SPDX-License-Identifier: MIT
// Budget of the link between two robots, wall by wall; the walls of the way are lit on the map.
/** @typedef {{entry_m: number, exit_m: number, material: string, loss_db: number}} Crossing */
/** @typedef {{from: string, to: string, distance_m: number, up: boolean, walls?: Crossing[]}} Link */
const pair_panel = (() => {
    "use strict";
    /** @type {{run: Run, pair: string, links: Link[][], robots: number[], t: number, done: () => void}} */
    const own = { run: /** @type {any} */ (null), pair: "?", links: [], robots: [], t: 0, done: () => {} };
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
            own.links = answers.map(answer => Array.isArray(answer.links) ? answer.links : []);
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
            panel.replaceChildren(dom.make("p", "", "Choose two robots: one by a click, the other by shift and click."));
            return;
        }
        const answer = dom.make("div", "");
        answer.id = "pair-answer";
        panel.replaceChildren(dom.make("h2", "", `${words.short(own.run.name(a), 24)} and ${words.short(own.run.name(b), 24)}`), between(a, b, state.t),
            server.is_served() ? dom.make("p", "actions", dom.button("budget at this time", "", () => ask(a, b))) : dom.make("p", "muted", server.how), answer);
    }

    /** What the page itself knows of two robots. @param {number} a @param {number} b @param {number} t */
    function between(a, b, t) {
        const r = own.run, p = r.pose(a, t, { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 }), q = r.pose(b, t, { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 });
        return dom.facts([["apart", `${Math.hypot(p.x - q.x, p.y - q.y, p.z - q.z).toFixed(2)} m at ${words.seconds(t, 3)} s`]]);
    }

    /** The way from one robot to the other in a run, its walls bold with their loss. @param {CanvasRenderingContext2D} c @param {number} i @param {State} state */
    function draw(c, i, state) {
        const link = own.links[i]?.[0];
        if (!link || state.panel !== "pair") return;
        const [a, b] = own.robots.map(robot => sides.own.all[i].run.pose(robot, own.t, { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 }));
        const x0 = camera.to_x(a.x), y0 = camera.to_y(a.y), x1 = camera.to_x(b.x), y1 = camera.to_y(b.y);
        const color = theme.on_scale(signs.look.colors.ember, 0.5);
        /** @param {number} from @param {number} to shares of the way @param {number} width */
        const part = (from, to, width) => {
            c.beginPath();
            c.moveTo(x0 + from * (x1 - x0), y0 + from * (y1 - y0));
            c.lineTo(x0 + to * (x1 - x0), y0 + to * (y1 - y0));
            c.strokeStyle = theme.readable(color);
            c.lineWidth = width;
            c.stroke();
        };
        part(0, 1, 1.4);
        c.font = `10px ${robots.font}`;
        c.textBaseline = "middle";
        /** @type {number[][]} */ const taken = [];
        for (const wall of link.walls ?? []) {
            const from = wall.entry_m / link.distance_m, to = wall.exit_m / link.distance_m;
            part(from, to, 7);
            label(c, `${words.number(wall.loss_db, 3)} dB`, x0 + (from + to) / 2 * (x1 - x0), y0 + (from + to) / 2 * (y1 - y0), taken);
        }
    }

    /** Text beside a place, where no other is. @param {CanvasRenderingContext2D} c @param {string} text @param {number} x @param {number} y @param {number[][]} taken */
    function label(c, text, x, y, taken) {
        const width = c.measureText(text).width + 4, half = 7;
        const places = [[8, -9], [8, 10], [-8 - width, 10], [-8 - width, -9], [8, -24], [-8 - width, 24]].map(([dx, dy]) => [x + dx, y + dy]);
        const free = places.find(([left, middle]) => taken.every(b => left >= b[2] || left + width <= b[0] || middle - half >= b[3] || middle + half <= b[1])) ?? places[0];
        taken.push([free[0], free[1] - half, free[0] + width, free[1] + half]);
        c.strokeStyle = theme.colors().paper;
        c.lineWidth = 3.5;
        c.strokeText(text, free[0], free[1]);
        c.fillStyle = theme.colors().ink;
        c.fillText(text, free[0], free[1]);
    }

    /** @param {Run} r */
    function show(r) { own.run = r; }

    /** @param {() => void} done */
    function begin(done) { own.done = done; }

    return { begin, show, update, draw };
})();

// SPDX-License-Identifier: MIT
// Files that the page saves: the map as a picture, the events as a table.
const files = (() => {
    "use strict";
    const margin = 16, heading = 52;

    /** Name of a file from the run's. @param {Run} r @param {string} end */
    function name(r, end) { return `${r.head.name.replace(/[^A-Za-z0-9._-]+/g, "_").slice(0, 60) || "run"}${end}`; }

    /** @param {Run} r @param {State} state */
    function picture(r, state) {
        const map_canvas = dom.canvas("map"), { height } = camera.now, width = map_canvas.clientWidth, out = document.createElement("canvas");
        const c = dom.sized(out, width + 2 * margin, height + heading + margin);
        c.fillStyle = theme.colors().paper;
        c.fillRect(0, 0, width + 2 * margin, height + heading + margin);
        c.fillStyle = theme.colors().ink;
        c.font = `bold ${pen.font(16)}`;
        c.fillText(words.shortened(sides.title(), 80), margin, 24);
        c.font = pen.font(12);
        c.fillStyle = theme.colors().muted;
        const length = camera.round_number(camera.now.width / 6 / camera.now.scale), bar = length * camera.now.scale;
        c.fillText(`at ${words.seconds(state.t)} s`, margin, 42);
        c.fillText(`${length} m`, margin + width - c.measureText(`${length} m`).width, 42);
        c.fillRect(margin + width - bar - 50, 37, bar, 2);
        c.drawImage(map_canvas, margin, heading, width, height);
        pen.take(c, theme.colors().line, 1);
        c.strokeRect(margin, heading, width, height);
        out.toBlob(blob => {
            if (blob) dom.save(name(r, `-${Number((state.t / 1e9).toFixed(6))}s.png`), blob);
        });
    }

    /** @param {string} text */
    function cell(text) {
        const safe = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;  // no formula for a spreadsheet
        return /[\x22,\n\r]/.test(safe) ? `\x22${safe.replaceAll("\x22", "\x22\x22")}\x22` : safe;
    }

    /** Events of the whole run that the filter lets through, after a heading. @param {Run} r @param {Blocks} all @param {Filter} filter */
    async function rows(r, all, filter) {
        const out = ["time_s,event,robot,other,message,outcome,text\n"];
        for (let n = 0; n < Math.max(1, all.info.length) && out.length <= files.most_rows; n++) {
            const block = all.info[n]?.flights ? await all.load(n) : null, before = n > 0 ? await all.load(n - 1) : null;
            const w = events.window_of(r, n, block, before);
            for (const i of events.filtered(r, w, filter).subarray(0, files.most_rows + 1 - out.length)) {
                const { who, other, message, sign } = events.about(r, w, i);
                out.push([words.plain(w.time[i]), events.kind_names[w.kind[i]], who >= 0 ? cell(r.name(who)) : "", other >= 0 && other < r.robots ? cell(r.name(other)) : "",
                    message >= 0 && message < r.messages ? String(r.col("messages.uid")[message]) : "", sign >= 0 ? cell(signs.kinds[sign].text) : "", cell(events.text(r, w, i))].join(",") + "\n");
            }
        }
        return out;
    }

    /** @param {Run} r @param {Blocks} all @param {State} state */
    async function table(r, all, state) {
        const out = await rows(r, all, state.filter);
        controls.say(out.length > files.most_rows ? "The table ends after 1,000,000 events." : "");
        dom.save(name(r, "-events.csv"), new Blob(out, { type: "text/csv" }));
    }

    /** The whole map as the server draws it. @param {Run} r @param {State} state */
    function drawing(r, state) {
        const shown = coverage.shown();
        controls.say("drawing \u2026");
        sides.ask("svg", { t_ns: state.t, storey: Math.max(0, state.storey), trails: state.trails, links: state.links, ...shown < 0 ? {} : { coverage: shown } }).then(answer => {
            dom.save(name(r, `-${Number((state.t / 1e9).toFixed(6))}s.svg`), new Blob([String(answer.svg)], { type: "image/svg+xml" }));
            controls.say("");
        }, error => controls.say(error.message));
    }

    return { picture, drawing, table, most_rows: 1000000 };
})();

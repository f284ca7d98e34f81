// SPDX-License-Identifier: MIT
// Time that passes while the run plays. Nothing is drawn again while it stands.
const clock = (() => {
    "use strict";
    const slowest = -6, fastest = 3;  // powers of ten
    let frame = 0, last = 0;

    /** @param {number} now [ms] */
    function tick(now) {
        frame = 0;
        const { state } = selection;
        if (!state.playing) return;
        const t = state.t + Math.min(250, now - last) * 1e6 * state.speed;
        last = now;
        const end = parts.end;
        if (t >= end && parts.open) live.reach();
        selection.set(t >= end ? { t: end, playing: parts.open } : { t: Math.max(0, t) });
        if (selection.state.playing) frame = requestAnimationFrame(tick);
    }
    const parts = { end: 0, open: false };

    /** @param {boolean} on */
    function play(on) {
        const { state } = selection;
        if (on && state.t >= parts.end && !parts.open) selection.set({ t: 0 });
        selection.set({ playing: on });
        if (!on || frame) return;
        last = performance.now();
        frame = requestAnimationFrame(tick);
    }

    /** @param {number} t [ns] */
    function seek(t) {
        live.leave();
        selection.set({ t: Math.min(parts.end, Math.max(0, t)) });
    }

    /** Speed as a power of ten, within bounds. @param {number} power */
    function set_power(power) {
        selection.set({ speed: 10 ** Math.min(fastest, Math.max(slowest, power)) });
        live.pace(selection.state.speed);
    }
    function power() { return Math.log10(selection.state.speed); }

    /** @param {number} speed */
    function speed_text(speed) {
        if (speed >= 0.0995) return `\u00d7 ${words.number(speed, 2)}`;
        return `1 s shows ${words.span(speed * run.nanoseconds)}`;
    }

    /** @param {number} end [ns] */
    function begin(end) { parts.end = end; }

    /** The run has come to a time. @param {number} end [ns] @param {boolean} open whether it goes on */
    function extend(end, open) { Object.assign(parts, { end, open }); }

    return { begin, extend, play, seek, set_power, power, speed_text };
})();

// SPDX-License-Identifier: MIT
// A run that goes on: takes its parts as they come, keeps up with it, and paces it where that is allowed.
/** @typedef {{now_ns: number, speed: number|null, paused: boolean, ended: boolean, controls_time: boolean, controls_robots: boolean, left_out: number, fingerprint?: string}} Live */
const live = (() => {
    "use strict";
    const lag_s = 0.25, renew_ms = 500;
    /** @type {{state: Live|null, run: Run|null, blocks: Blocks|null, follows: boolean, gone: boolean, coming: Promise<unknown>, renewed: number, changed: () => void, failed: (error: unknown) => void, open: (bytes: Uint8Array) => Promise<void>}} */
    const own = { state: null, run: null, blocks: null, follows: true, gone: false, coming: Promise.resolve(), renewed: 0, changed: () => {}, failed: () => {}, open: async () => {} };

    function goes_on() { return own.state !== null && !own.state.ended && !own.gone; }
    function may_pace() { return goes_on() && own.state?.controls_time === true; }

    /** Real-time distance that the page keeps from the present, as simulated time [ns]. */
    function lag() { return lag_s * (own.state?.speed ?? 0) * run.nanoseconds; }

    /** Takes the state of the run. @param {Live} state */
    function take(state) {
        own.state = state;
        clock.extend(state.now_ns, goes_on());
        if (own.run && state.now_ns > own.run.duration) own.run.duration = state.now_ns;
        if (own.follows && state.speed !== null && selection.state.speed !== state.speed) selection.set({ speed: state.speed });
        if (!own.follows) return;
        const behind = state.now_ns - selection.state.t, present = state.speed === null || state.paused || state.ended || own.gone || theme.is_still();
        if (present) selection.set({ t: state.now_ns });
        else if (behind > 2 * lag()) selection.set({ t: Math.max(0, state.now_ns - lag()) });
        if (present) selection.set({ playing: false });
        else if (!selection.state.playing) clock.play(true);
    }

    /** Panels that are made of the whole run, some times a second. */
    function renew() {
        const now = performance.now();
        if (now - own.renewed < renew_ms && goes_on() && !own.state?.paused) return;
        own.renewed = now;
        message_panel.renew();
        robot_panel.renew();
    }

    /** Takes a file of the server: the first is the run, the others are what came since. @param {Uint8Array} bytes */
    async function arrived(bytes) {
        if (!own.run || !own.blocks) {
            await own.open(bytes);
            return;
        }
        const file = rvw.open(bytes, undefined, head_check.part_fault);
        await growth.add(own.run, own.blocks, file);
        address.grown(own.run);
        list.renew();
        if (file.head.live) take(file.head.live);
        renew();
        own.changed();
    }

    /** @param {Run} r @param {Blocks} all */
    function begin(r, all) {
        own.run = r;
        own.blocks = all;
        const state = r.head.live;
        if (!state) return;
        own.follows = !/[#&]t=/.test(location.hash);
        take(state);
    }

    function lost() {
        if (own.gone) return;
        own.gone = true;
        own.coming.then(() => {
            clock.extend(own.state?.now_ns ?? 0, false);
            own.changed();
            if (!own.run) own.failed(new rvw.ViewError(`The server has gone, or does not know this page. ${server.token_hint}`));
            if (!own.state?.ended) server.come_back();
        });
    }

    /** Gets the run from the server, file by file. @param {(bytes: Uint8Array) => Promise<void>} open @param {() => void} changed @param {(error: unknown) => void} failed */
    function watch(open, changed, failed) {
        Object.assign(own, { open, changed, failed });
        server.watch(bytes => own.coming = own.coming.then(() => arrived(bytes)).catch(failed), lost);
    }

    /** Goes to the present, and keeps up with it. */
    function follow() {
        if (!own.state) return;
        own.follows = true;
        selection.set({ t: own.state.now_ns });
        take(own.state);
    }

    /** Asks the server, and tells what it answers if it refuses. @param {string} op @param {Record<string, unknown>} fields */
    function ask(op, fields) {
        return server.ask(op, fields).then(() => controls.say(""), error => controls.say(error.message));
    }

    /** Play or pause: of the run if the page shows its present and may pace it, else of the page alone. */
    function play() {
        const on = !selection.state.playing, at_present = own.follows || selection.state.t >= (own.state?.now_ns ?? Infinity);
        if (may_pace() && at_present) {
            own.follows = true;
            ask("pace", { paused: !own.state?.paused });
        } else {
            if (!on) own.follows = false;
            clock.play(on);
        }
    }

    /** Speed of what is played: of the run if the page follows it. @param {number} speed */
    function pace(speed) { if (may_pace() && own.follows) ask("pace", { speed }); }

    /** One step of the run, if the page shows its present and the run is paused. @returns {boolean} whether it is one */
    function step() {
        if (!may_pace() || !own.state?.paused || selection.state.t < own.state.now_ns) return false;
        own.follows = true;
        ask("step", { ns: Math.max(1, Math.round(0.1 * selection.state.speed * run.nanoseconds)) });
        return true;
    }

    /** The user goes to a time. */
    function leave() { own.follows = false; }
    /** The page has come to the present by playing. */
    function reach() { own.follows = true; }

    /** Words for the button of the present. */
    function text() {
        const { state } = own;
        if (!state) return "";
        if (own.gone && !state.ended) return "server gone";
        if (state.ended) return "run ended";
        if (state.paused) return "run paused";
        return own.follows ? "live" : "to the present";
    }

    return { begin, watch, play, pace, step, follow, leave, reach, text, goes_on, ask, is_live: () => own.state !== null, follows: () => own.follows, state: () => own.state };
})();

// SPDX-License-Identifier: MIT
// What is shown: one state, and those who want to know of its changes.
/** @typedef {{robot: number, message: number, signs: number, kinds: number}} Filter */
/** @typedef {{x: number, y: number, scale: number}} View */
/** @typedef {{t: number, playing: boolean, speed: number, storey: number, view: View|null, span: {from: number, to: number}|null, robots: number[], message: number, filter: Filter, panel: string, trails: boolean, links: boolean, all: boolean, coverage: number, runs: string}} State */
/** @typedef {(changed: Set<keyof State>, state: State) => void} Listener */
const selection = (() => {
    "use strict";

    const everything = 0xffff;
    /** @returns {Filter} */
    const no_filter = () => ({ robot: -1, message: -1, signs: everything, kinds: everything });

    /** @type {State} */
    const state = {
        t: 0, playing: false, speed: 1, storey: 0, view: null, span: null, robots: [], message: -1,
        filter: no_filter(), panel: "events", trails: true, links: false, all: false, coverage: -1, runs: "A"
    };
    /** @type {Listener[]} */ const listeners = [];

    /** @param {Partial<State>} patch */
    function set(patch) {
        /** @type {Set<keyof State>} */ const changed = new Set();
        for (const key of /** @type {(keyof State)[]} */ (Object.keys(patch))) {
            if (state[key] !== patch[key]) changed.add(key);
        }
        if (changed.size === 0) return;
        Object.assign(state, patch);
        for (const listener of listeners) listener(changed, state);
    }

    /** @param {Listener} listener */
    function listen(listener) { listeners.push(listener); }

    /** Chooses a robot, alone or with the ones before (two at most). @param {number} robot @param {boolean} [also] */
    function choose(robot, also = false) {
        const others = also ? state.robots.filter(r => r !== robot).slice(-1) : [];
        set({ robots: robot < 0 ? [] : [...others, robot] });
    }

    return { state, set, listen, choose, everything };
})();

// SPDX-License-Identifier: MIT
// Questions to the server of the page, which computes what the run does not hold.
const server = (() => {
    "use strict";
    const patience_ms = 20000;
    /** @type {{socket: WebSocket|null, served: boolean, query: string, next: number, open: Map<number, {done: (answer: any) => void, failed: (error: Error) => void}>}} */
    const own = { socket: null, served: false, query: "", next: 1, open: new Map() };

    const how = "This page is a file, so nobody answers. Open the run by \u201crovernet view RUN\u201d to ask.";

    /** @param {string} data */
    function receive(data) {
        let answer;
        try {
            answer = JSON.parse(data);
        } catch {
            return;
        }
        const waiting = own.open.get(answer?.id);
        if (!waiting) return;
        own.open.delete(answer.id);
        if (typeof answer.error === "string") waiting.failed(new Error(answer.error)); else waiting.done(answer);
    }

    function drop_all() {
        for (const { failed } of own.open.values()) failed(new Error("The server has gone."));
        own.open.clear();
        own.socket = null;
    }

    /** @returns {Promise<WebSocket>} */
    function connected() {
        return new Promise((done, failed) => {
            if (!own.served) return failed(new Error(how));
            const there = own.socket ?? new WebSocket(`ws${location.protocol === "https:" ? "s" : ""}://${location.host}/${own.query}`);
            if (!own.socket) {
                there.addEventListener("message", event => receive(String(event.data)));
                there.addEventListener("close", drop_all);
                own.socket = there;
            }
            if (there.readyState === WebSocket.OPEN) return done(there);
            there.addEventListener("open", () => done(there), { once: true });
            there.addEventListener("close", () => failed(new Error("The server has gone. Start \u201crovernet view RUN\u201d again.")), { once: true });
        });
    }

    /** @param {string} op @param {Record<string, number|string>} fields @returns {Promise<any>} */
    async function ask(op, fields) {
        const socket = await connected(), id = own.next++;
        return new Promise((done, failed) => {
            own.open.set(id, { done, failed });
            setTimeout(() => {
                if (own.open.delete(id)) failed(new Error("The server did not answer."));
            }, patience_ms);
            socket.send(JSON.stringify({ id, op, ...fields }));
        });
    }

    /** The run that the server shows. A token leaves the address bar: addresses are copied. @returns {Promise<Uint8Array>} */
    async function run_bytes() {
        own.served = true;
        own.query = location.search;
        const answer = await fetch("/run.rvw" + own.query);
        if (!answer.ok) return rvw.refuse(`The server refuses the run: ${answer.status} ${answer.statusText}.`);
        if (own.query) history.replaceState(null, "", location.pathname + location.hash);
        return new Uint8Array(await answer.arrayBuffer());
    }

    return { run_bytes, ask, how, is_served: () => own.served };
})();

// SPDX-License-Identifier: MIT
// Questions to the server of the page, which computes what the run does not hold.
const server = (() => {
    "use strict";
    const patience_ms = 20000, again_ms = 1500, kept = "rovernet-token";
    /** @type {{socket: WebSocket|null, served: boolean, query: string, file: (bytes: Uint8Array) => void, gone: () => void, next: number, open: Map<number, {done: (answer: any) => void, failed: (error: Error) => void}>}} */
    const own = { socket: null, served: false, query: "", file: () => {}, gone: () => {}, next: 1, open: new Map() };

    const how = "This page is a file without a server. To ask, open the run by \u201crovernet view RUN\u201d.";

    const token_hint = "Open the address with ?token= that the server printed.";

    /** @param {string|ArrayBuffer} data */
    function receive(data) {
        if (typeof data !== "string") return own.file(new Uint8Array(data));
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
        own.gone();
    }

    /** @returns {Promise<WebSocket>} */
    function connected() {
        return new Promise((done, failed) => {
            if (!own.served) return failed(new Error(how));
            const there = own.socket ?? new WebSocket(`ws${location.protocol === "https:" ? "s" : ""}://${location.host}/${own.query}`);
            if (!own.socket) {
                there.addEventListener("message", event => receive(event.data));
                there.addEventListener("close", drop_all);
                there.binaryType = "arraybuffer";
                own.socket = there;
            }
            if (there.readyState === WebSocket.OPEN) return done(there);
            there.addEventListener("open", () => done(there), { once: true });
            there.addEventListener("close", () => failed(new Error("The server has gone. Open the run by \u201crovernet view RUN\u201d.")), { once: true });
        });
    }

    /** @param {string} op @param {Record<string, unknown>} fields @returns {Promise<any>} */
    async function ask(op, fields) {
        const socket = await connected(), id = own.next++, { t_ns } = fields;
        if (typeof t_ns === "number") fields = { ...fields, t_ns: Math.floor(t_ns) };  // a time between two ns is shown, too
        return new Promise((done, failed) => {
            own.open.set(id, { done, failed });
            setTimeout(() => {
                if (own.open.delete(id)) failed(new Error("The server did not answer."));
            }, patience_ms);
            socket.send(JSON.stringify({ id, op, ...fields }));
        });
    }

    /** Takes the files of a run that goes on. @param {(bytes: Uint8Array) => void} file @param {() => void} gone the server went */
    function watch(file, gone) {
        begin();
        Object.assign(own, { file, gone });
        connected().catch(gone);
    }

    /** Loads the page again once a server is there. */
    function come_back() {
        const probe = new WebSocket(`ws://${location.host}/${own.query}`);
        probe.addEventListener("open", () => own.query ? location.replace("/" + own.query + location.hash) : location.reload());
        probe.addEventListener("error", () => setTimeout(come_back, again_ms));
    }

    /** The page is served. A token leaves the address bar, since addresses are copied; the tab keeps it for when the page is loaded again. */
    function begin() {
        own.served = true;
        try {
            if (location.search) sessionStorage.setItem(kept, location.search);
            own.query = sessionStorage.getItem(kept) ?? "";
        } catch {
            own.query = location.search || own.query;  // a browser that stores nothing
        }
        if (location.search) history.replaceState(null, "", location.pathname + location.hash);
    }

    /** A view file of the server. @param {string} name @returns {Promise<Uint8Array>} */
    async function run_bytes(name) {
        begin();
        const answer = await fetch(`/${name}.rvw${own.query}`);
        if (answer.status === 403) return rvw.refuse(`The server does not know this page. ${token_hint}`);
        if (!answer.ok) return rvw.refuse(`The server refuses the run: ${answer.status} ${answer.statusText}.`);
        return new Uint8Array(await answer.arrayBuffer());
    }

    return { run_bytes, watch, come_back, ask, how, token_hint, is_served: () => own.served };
})();

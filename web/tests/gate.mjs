// Responses of the server held back in the page: an initial script of the browser, with the first frames to hold.

/** Holds the frames of the server whose kind and stage `held` names, until they are let in; `late` holds the reading of files. */
export function gate(first) {
    const state = { held: first, late: undefined, frames: [], files: [], last: {}, hear: undefined };
    const matches = (pattern, text) => pattern !== undefined && new RegExp(pattern).test(text);
    window.gate = {
        hold: (pattern) => (state.held = pattern),
        holdFiles: (pattern) => (state.late = pattern),
        /** Lets a fault in as the response to the last request of a kind that had one. */
        fault: (ask, message) => {
            const head = new TextEncoder().encode(JSON.stringify({ id: state.last[ask], ask, stage: "fault", faults: [{ key: "", line: 0, message }], arrays: [] }));
            const data = new ArrayBuffer(4 + head.length);
            new DataView(data).setUint32(0, head.length, true);
            new Uint8Array(data, 4).set(head);
            state.hear({ data });
        },
        waiting: () => state.frames.length,
        open: () => {
            state.held = undefined;
            for (const deliver of state.frames.splice(0)) deliver();
        },
        openFiles: () => {
            state.late = undefined;
            for (const read of state.files.splice(0)) read();
        },
    };
    const Real = window.WebSocket;
    window.WebSocket = class extends Real {
        set onmessage(hear) {
            state.hear = hear;
            super.onmessage = (event) => {
                const length = new DataView(event.data).getUint32(0, true);
                const { id, ask, stage } = JSON.parse(new TextDecoder().decode(new Uint8Array(event.data, 4, length)));
                state.last[ask] = id;
                if (matches(state.held, `${ask} ${stage}`)) state.frames.push(() => hear(event));
                else hear(event);
            };
        }
    };
    const read = FileReader.prototype.readAsDataURL;
    FileReader.prototype.readAsDataURL = function (file) {
        if (matches(state.late, file.name)) state.files.push(() => read.call(this, file));
        else read.call(this, file);
    };
}

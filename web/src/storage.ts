// Storage of the browser. In a frame of another site, as in a notebook, a browser may refuse it: the page then remembers nothing.

function storage(name: "localStorage" | "sessionStorage"): Storage | undefined {
    try {
        return window[name];
    } catch {
        return undefined;
    }
}

/** Kept until the user clears it. */
export const userStorage = storage("localStorage");

/** Kept until the tab is closed. */
export const tabStorage = storage("sessionStorage");

// Keys of the page: undo, redo, pin, link, save, export, theme, value of the selected point, list of the keys.

const SINGLE: Record<string, string> = { p: "pin", l: "share", e: "export", s: "save", t: "theme", u: "use", "?": "keys" };

/** Runs the named actions on their keys, except while a text is typed. */
export function shortcuts(act: Record<string, () => void>): void {
    addEventListener("keydown", (event) => {
        const typing = event.target instanceof HTMLInputElement && !["range", "checkbox"].includes(event.target.type);
        if (typing || event.altKey) return;
        const key = event.key.toLowerCase();
        const control = event.ctrlKey || event.metaKey;
        const redo = key === "y" || (key === "z" && event.shiftKey);
        const name = control ? (redo ? "redo" : key === "z" ? "undo" : "") : event.target instanceof HTMLSelectElement ? "" : SINGLE[key];
        if (!name) return;
        if (control) event.preventDefault();
        act[name]();
    });
}

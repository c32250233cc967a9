// Paper is white, and its charts are vectors: for a print, the drawing of each canvas takes the place of its pixels.

import { put } from "./picture";
import type { Theme } from "./theme";

/** A drawing on a canvas that can be made as SVG for a print. */
export interface Drawn {
    readonly canvas: HTMLCanvasElement | undefined;
    svg(paper?: string): string | undefined;
    /** As it is printed. */
    printed(): string | undefined;
}

/** Class of the drawings of a print; `colours.css` hides the canvases before them. */
const PRINTED = "printed";

/** Prepares the page for each print; `before` is called first. */
export function preparePrints(theme: Theme, drawings: () => Iterable<Drawn>, before: () => void = () => {}): void {
    const clear = () => document.querySelectorAll(`.${PRINTED}`).forEach((printed) => printed.remove());
    addEventListener("beforeprint", () => {
        before();
        clear();
        theme.show("light");
        for (const drawing of drawings()) {
            const { canvas } = drawing;
            if (!canvas?.checkVisibility()) continue;
            const printed = document.createElement("div");
            printed.className = PRINTED;
            put(printed, drawing.printed() ?? "", "");
            canvas.after(printed);
        }
    });
    addEventListener("afterprint", () => {
        clear();
        theme.show();
    });
}

// The line of the operating point on a chart, dragged with the mouse or a finger.

import type { Chart } from "./chart";

/** Distance from the line at which it is caught, CSS pixels. */
const CATCH = 7;

export class LineHandle {
    /** True from the first movement until the click that ends it. */
    dragged = false;
    private held = false;

    get isHeld(): boolean {
        return this.held;
    }

    constructor(private readonly chart: Chart, private readonly at: () => number | undefined, private readonly move: (value: number, moving: boolean) => void) {
        const { host } = chart;
        host.addEventListener("pointerdown", (event) => {
            this.dragged = false;
            this.held = this.isNear(event);
            if (this.held) host.setPointerCapture(event.pointerId);
        });
        host.addEventListener("pointermove", (event) => {
            host.style.cursor = this.held || this.isNear(event) ? "ew-resize" : "";
            if (this.held) this.drag(event, true);
        });
        host.addEventListener("pointerup", (event) => {
            if (this.held && this.dragged) this.drag(event, false);
            this.held = false;
        });
    }

    private offset(event: PointerEvent): number {
        return event.clientX - (this.chart.over?.getBoundingClientRect().left ?? 0);
    }

    private isNear(event: PointerEvent): boolean {
        const at = this.at();
        return at !== undefined && Math.abs(this.chart.place(at, 1)[0] - this.offset(event)) < CATCH;
    }

    private drag(event: PointerEvent, moving: boolean): void {
        this.dragged = true;
        this.move(this.chart.valueAt(this.offset(event)), moving);
    }
}

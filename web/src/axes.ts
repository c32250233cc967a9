// Range of the response: a key with both ends, in the unit of its control.

import type { Control, Controls } from "./controls";
import type { View } from "./design";
import { write } from "./typed";
import { digits, sign } from "./units";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Axes {
    private readonly over = find<HTMLSelectElement>("over");
    private readonly from = find<HTMLInputElement>("from");
    private readonly to = find<HTMLInputElement>("to");
    private readonly unit = find("over-unit");
    private readonly fault = find("range-fault");
    view: View | undefined;
    /** View over a key that the present design lacks; it returns with its key. */
    private missing: View | undefined;
    /** True while the view is that of a link, and no design has been seen with it. */
    private linked = false;
    onChange: () => void = () => {};

    constructor(private readonly controls: Controls) {
        this.over.onchange = () => this.pick(this.over.value);
        find("widen").onclick = () => this.widen();
        this.from.onchange = this.to.onchange = () => this.read();
    }

    /** Offers the keys of a design; initially the frequency of the first sinusoidal drive. Returns the key of the axis of a link that the design lacks. */
    offer(): string | undefined {
        const keys = this.controls.ordered.filter((control) => !control.count).map((control) => control.key);
        if (keys.join() !== [...this.over.options].map((option) => option.value).join()) {
            this.over.replaceChildren(...keys.map((key) => new Option(this.controls.title(key), key)));
        }
        const isKnown = (view: View | undefined) => view !== undefined && keys.includes(view.over);
        const wanted = this.missing ?? this.view;
        const unknown = this.linked && !isKnown(wanted) ? wanted?.over : undefined;
        this.linked = false;
        this.missing = isKnown(wanted) ? undefined : wanted;
        if (isKnown(wanted)) this.view = wanted;
        else if (!isKnown(this.view)) {
            const first = keys.find((key) => /^drive\..*\.frequency$/.test(key)) ?? keys[0];
            if (first) this.view = this.around(this.controls.find(first)!);
        }
        if (isKnown(this.view)) this.show(this.view!);
        return unknown;
    }

    /** Shows twice the range: twice the ratio of its ends where both are positive. */
    private widen(): void {
        if (!this.view) return;
        const { over, from, to } = this.view;
        if (!this.controls.find(over)) return;
        const [half, share] = [(to - from) / 2, Math.sqrt(to / from)];
        this.change({ over, ...(from > 0 ? { from: from / share, to: to * share } : { from: from - half, to: to + half }) });
    }

    /** Extends the range to a value, with a twentieth of its width beyond it: of the ratio of its ends where all are positive. */
    include(value: number): void {
        if (!this.view) return;
        const { over, from, to } = this.view;
        const [room, share] = [(to - from) / 20, (to / from) ** 0.05];
        const [low, high] = from > 0 && value > 0 ? [value / share, value * share] : [value - room, value + room];
        this.change({ over, from: Math.min(from, low), to: Math.max(to, high) });
    }

    /** Takes the view of a link. */
    set(view: View): void {
        this.linked = true;
        this.missing = undefined;
        this.view = view;
    }

    /** Shows another range. */
    change(view: View): void {
        this.missing = undefined;
        this.view = view;
        this.show(view);
        this.onChange();
    }

    private around(control: Control): View {
        const wide = /frequency$/.test(control.key) ? [0.88, 1.14] : [0.5, 1.5];
        return { over: control.key, from: wide[0] * control.value, to: wide[1] * control.value };
    }

    private pick(key: string): void {
        this.change(this.around(this.controls.find(key)!));
    }

    private show(view: View): void {
        const control = this.controls.find(view.over)!;
        this.over.value = view.over;
        write(this.from, digits(view.from / control.factor, 5));
        write(this.to, digits(view.to / control.factor, 5));
        this.unit.textContent = sign(control.unit);
        this.tell("");
    }

    private read(): void {
        const control = this.controls.find(this.over.value);
        if (!control) return;
        const [from, to] = [Number(this.from.value) * control.factor, Number(this.to.value) * control.factor];
        if (!(from < to)) return this.tell("The range must go from a smaller to a larger number.");
        this.change({ over: control.key, from, to });
    }

    /** Shows the fault of the ends, or none. */
    private tell(words: string): void {
        for (const field of [this.from, this.to]) field.setAttribute("aria-invalid", String(words !== ""));
        this.fault.textContent = words;
        this.fault.hidden = words === "";
    }
}

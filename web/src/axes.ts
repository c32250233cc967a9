// Range of the response: a key with both ends, in the unit of its control.

import type { Control, Controls } from "./controls";
import type { View } from "./design";
import { digits, sign } from "./units";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Axes {
    private readonly over = find<HTMLSelectElement>("over");
    private readonly from = find<HTMLInputElement>("from");
    private readonly to = find<HTMLInputElement>("to");
    private readonly unit = find("over-unit");
    view: View | undefined;
    onChange: () => void = () => {};
    /** Called with the error of a range, or with nothing for a valid one. */
    onWrong: (words: string) => void = () => {};

    constructor(private readonly controls: Controls) {
        this.over.onchange = () => this.pick(this.over.value);
        this.from.onchange = this.to.onchange = () => this.read();
    }

    /** Offers the keys of a design; initially the frequency of the first sinusoidal drive. Returns the key of the axis if the design lacks it. */
    offer(): string | undefined {
        const keys = this.controls.all.filter((control) => !control.count).map((control) => control.key);
        if (keys.join() !== [...this.over.options].map((option) => option.value).join()) {
            this.over.replaceChildren(...keys.map((key) => new Option(this.controls.title(key), key)));
        }
        const unknown = this.view && !keys.includes(this.view.over) ? this.view.over : undefined;
        if (this.view && !unknown) this.show(this.view);
        else {
            const first = keys.find((key) => /^drive\..*\.frequency$/.test(key)) ?? keys[0];
            if (first) this.view = this.around(this.controls.find(first)!);
            if (this.view) this.show(this.view);
        }
        return unknown;
    }

    set(view: View): void {
        this.view = view;
    }

    /** Shows another range. */
    change(view: View): void {
        this.view = view;
        this.onWrong("");
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
        this.from.value = digits(view.from / control.factor, 5);
        this.to.value = digits(view.to / control.factor, 5);
        this.unit.textContent = sign(control.unit);
        for (const field of [this.from, this.to]) field.setAttribute("aria-invalid", "false");
    }

    private read(): void {
        const control = this.controls.find(this.over.value);
        if (!control) return;
        const [from, to] = [Number(this.from.value) * control.factor, Number(this.to.value) * control.factor];
        const right = from < to;
        for (const field of [this.from, this.to]) field.setAttribute("aria-invalid", String(!right));
        if (!right) return this.onWrong(`${control.key}: the range must go from a smaller to a larger number`);
        this.change({ over: control.key, from, to });
    }
}

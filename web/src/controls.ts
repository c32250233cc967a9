// Sliders and fields for every number of the spec; a fault is shown next to its control.

import type { Design } from "./design";
import type { Fault } from "./frame";
import { write } from "./typed";
import { withUnit } from "./rows";
import { digits, sign } from "./units";

export interface Control {
    key: string;
    value: number;
    shown: string;
    unit: string;
    factor: number;
    about: string;
    scale: "linear" | "log";
    from: number;
    to: number;
    count: boolean;
    written: boolean;
}

/** A number that the spec lacks and may have. */
export interface OptionalKey {
    key: string;
    unit: string;
    about: string;
}

const STEPS = 1000;
/** Groups that are initially open. */
const OPEN = /^(stop|circuit|drive)\./;

interface Row {
    control: Control;
    slider: HTMLInputElement;
    field: HTMLInputElement;
    fault: HTMLElement;
    row: HTMLElement;
}

export class Controls {
    private readonly rows = new Map<string, Row>();
    private readonly opened = new Map<string, boolean>();
    private list: Control[] = [];
    private optional: OptionalKey[] = [];
    private readonly faults = new Map<string, Fault[]>();

    constructor(private readonly host: HTMLElement, private readonly general: HTMLElement, private readonly design: Design) {}

    get all(): Control[] {
        return this.list;
    }

    /** All, those of stops, circuits and drives first. */
    get ordered(): Control[] {
        return [...this.list].sort((a, b) => Number(OPEN.test(b.key)) - Number(OPEN.test(a.key)));
    }

    find(key: string): Control | undefined {
        return this.rows.get(key)?.control;
    }

    /**
     * Shows the controls of a design; rows with equal keys are reused, so that a held slider remains held. Where the user has set a
     * newer value of a key, `isPresent` is false, and its slider and field remain.
     */
    take(list: Control[], optional: OptionalKey[], isPresent: (key: string) => boolean): void {
        // A key that is set for the first time moves to another place of the list; its row remains.
        const same = list.length === this.rows.size && list.every((control) => this.rows.has(control.key)) && optional.length === this.optional.length;
        this.list = list;
        this.optional = optional;
        if (!same) this.build();
        for (const control of list) this.put(control, isPresent(control.key));
    }

    /** Axis title of a key, "Drive frequency" for that of the only drive. */
    title(key: string): string {
        const [table, name, ...rest] = key.split(".");
        const alone = new Set(this.list.map((control) => control.key.split(".")).filter((parts) => parts[0] === table && parts.length > 2).map((parts) => parts[1])).size === 1;
        const parts = (rest.length === 0 ? [table, name] : alone ? [table, ...rest] : [table, name, ...rest]).filter(Boolean);
        const words = parts.filter((own, k) => own !== parts[k - 1]).join(" ").replaceAll("_", " ");
        return words[0].toUpperCase() + words.slice(1);
    }

    /** Formats a value in SI as in the spec, with at most `count` digits. */
    words(key: string, si: number, count = 6): string {
        const control = this.find(key);
        if (!control) return String(si);
        const number = digits(si / control.factor, count);
        return control.count ? String(Math.round(si)) : control.unit ? `${number} ${control.unit}` : number;
    }

    /** Shows the faults of one source, with those of the others: next to their controls, or above all. */
    tell(source: string, faults: Fault[]): void {
        this.faults.set(source, faults);
        const beside = new Map<string, string>();
        const rest: string[] = [];
        const all = [...this.faults.values()].flat();
        // Two requests of one design have the same fault.
        const different = all.filter((fault, k) => all.findIndex(({ key, message }) => key === fault.key && message === fault.message) === k);
        for (const { key, message } of different) {
            if (this.rows.has(key)) beside.set(key, beside.has(key) ? `${beside.get(key)} ${message}` : message);
            else rest.push(message);
        }
        for (const [key, { fault, field, row }] of this.rows) {
            const message = beside.get(key) ?? "";
            if (fault.textContent !== message) fault.textContent = message;
            fault.hidden = message === "";
            field.setAttribute("aria-invalid", String(message !== ""));
            if (!message) continue;
            for (let group = row.closest("details"); group; group = group.parentElement!.closest("details")) group.open = true;
        }
        const text = rest.join("\n");
        if (this.general.textContent !== text) this.general.textContent = text;
    }

    private build(): void {
        this.rows.clear();
        const groups = new Map<string, Control[]>();
        for (const control of this.list) {
            const name = groupOf(control.key);
            groups.set(name, [...(groups.get(name) ?? []), control]);
        }
        const order = [...groups].sort(([a], [b]) => Number(OPEN.test(`${b}.`)) - Number(OPEN.test(`${a}.`)));
        const focused = this.host.contains(document.activeElement) ? nameOf(document.activeElement!) : undefined;
        this.host.replaceChildren(...order.map(([name, controls]) => this.group(name, controls)));
        if (focused !== undefined) this.focus(focused);
    }

    /** Gives the focus to the new element of a name, whose group opens. */
    private focus(name: string): void {
        const found = [...this.host.querySelectorAll<HTMLElement>("input, button, summary")].find((own) => nameOf(own) === name);
        for (let group = found?.parentElement?.closest("details"); group; group = group.parentElement?.closest("details")) group.open = true;
        found?.focus();
    }

    private group(name: string, controls: Control[]): HTMLElement {
        const details = document.createElement("details");
        details.open = this.opened.get(name) ?? OPEN.test(`${name}.`);
        details.ontoggle = () => this.opened.set(name, details.open);
        const summary = document.createElement("summary");
        // A beam that is named "beam".
        summary.textContent = [...new Set(name.split("."))].join(" ");
        const written = controls.filter((control) => control.written);
        const others = controls.filter((control) => !control.written);
        details.append(summary, ...written.map((control) => this.row(control, name)));
        const optional = this.optional.filter(({ key }) => groupOf(key) === name);
        details.append(...optional.map((one) => this.optionalRow(one, name)));
        if (others.length > 0) {
            const more = document.createElement("details");
            more.className = "more";
            const words = document.createElement("summary");
            words.textContent = `${others.length} with defaults`;
            words.setAttribute("aria-label", `${name.replaceAll(".", " ")}: ${words.textContent}`);
            more.append(words, ...others.map((control) => this.row(control, name)));
            if (written.length === 0) more.open = true;
            details.append(more);
        }
        return details;
    }

    /** A field for a number that the spec lacks; once it is set, the number has a slider. */
    private optionalRow({ key, unit, about }: OptionalKey, group: string): HTMLElement {
        const row = document.createElement("div");
        row.className = "control";
        const label = document.createElement("label");
        label.textContent = words(key, group);
        label.title = `${label.textContent}: ${about}`;
        const field = document.createElement("input");
        field.className = "field";
        field.placeholder = "none";
        field.id = `control-${key.replaceAll(".", "-")}`;
        field.setAttribute("aria-label", `${key}, value`);
        label.htmlFor = field.id;
        field.onchange = () => {
            if (field.value.trim()) this.design.set(key, withUnit(field.value, unit));
        };
        const sized = document.createElement("span");
        sized.className = "unit";
        sized.textContent = unit;
        row.append(label, field, sized);
        return row;
    }

    private row(control: Control, group: string): HTMLElement {
        const row = document.createElement("div");
        row.className = "control";
        const id = `control-${control.key.replaceAll(".", "-")}`;
        const label = document.createElement("label");
        label.htmlFor = id;
        label.textContent = words(control.key, group) || control.key;
        label.title = `${label.textContent}: ${control.about}`;
        const slider = document.createElement("input");
        slider.type = "range";
        slider.min = "0";
        slider.max = String(STEPS);
        slider.step = "1";
        slider.id = id;
        slider.setAttribute("aria-label", control.key);
        const field = document.createElement("input");
        field.inputMode = "decimal";
        field.className = "field";
        field.setAttribute("aria-label", `${control.key}, value`);
        field.setAttribute("aria-describedby", `${id}-fault`);
        const restore = document.createElement("button");
        restore.className = "restore";
        restore.textContent = "↺";
        restore.title = "Restore the value of the file";
        restore.setAttribute("aria-label", `${control.key}: restore the value of the file`);
        restore.onclick = () => this.design.restore(control.key);
        const unit = document.createElement("span");
        unit.className = "unit";
        unit.textContent = unit.title = sign(control.unit);
        const fault = document.createElement("p");
        fault.className = "fault";
        fault.id = `${id}-fault`;
        fault.hidden = true;
        slider.oninput = () => this.slide(control.key, true);
        slider.onchange = () => this.slide(control.key, false);
        field.onchange = () => this.type(control.key);
        row.append(label, field, unit, restore, slider, fault);
        this.rows.set(control.key, { control, slider, field, fault, row });
        return row;
    }

    /** Shows a value; the range of a slider remains while the value is inside it. */
    private put(control: Control, isPresent: boolean): void {
        const row = this.rows.get(control.key)!;
        const { from, to, scale, unit, factor } = row.control;
        const inside = control.value >= from && control.value <= to;
        row.control = inside ? { ...control, from, to, scale, unit, factor } : control;
        if (!inside || control.value === 0) row.row.querySelector(".unit")!.textContent = sign(row.control.unit);
        row.row.classList.toggle("changed", this.design.overrides.has(control.key));
        const text = this.number(row.control);
        if (!isPresent) return;
        write(row.field, text);
        row.slider.value = String(this.toStep(row.control, control.value));
        row.slider.setAttribute("aria-valuetext", `${text} ${row.control.unit}`);
    }

    private number(control: Control): string {
        return digits(control.value / control.factor, 6);
    }

    private toStep({ from, to, scale }: Control, value: number): number {
        const share = scale === "log" ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
        return Math.round(STEPS * share);
    }

    private fromStep({ from, to, scale, count }: Control, step: number): number {
        const share = step / STEPS;
        const value = scale === "log" ? from * (to / from) ** share : from + (to - from) * share;
        return count ? Math.max(1, Math.round(value)) : value;
    }

    private slide(key: string, moving: boolean): void {
        const { control, slider, field } = this.rows.get(key)!;
        const text = digits(this.fromStep(control, Number(slider.value)) / control.factor, 4);
        field.value = text;
        this.design.set(key, control.unit ? `${text} ${control.unit}` : text, moving);
    }

    private type(key: string): void {
        const { control, field } = this.rows.get(key)!;
        this.design.set(key, withUnit(field.value, control.unit));
    }
}

/** Name of an element for a screen reader. */
const nameOf = (element: Element) => element.ariaLabel ?? element.textContent!;

/** Table and name of a key: "stop.tip". */
function groupOf(key: string): string {
    const parts = key.split(".");
    return parts.length > 2 ? `${parts[0]}.${parts[1]}` : parts[0];
}

/** Words of a key in its group. */
function words(key: string, group: string): string {
    return key.slice(group.length + 1).replaceAll(".", " ").replaceAll("_", " ");
}

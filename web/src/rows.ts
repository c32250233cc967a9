// Rows of a design problem that the user adds and removes: one key each, with its fields and its fault.

/** Fault of a field of a design: its table and key in the design file. */
export interface FieldFault {
    table?: string;
    key: string;
    message: string;
}

/** Fields of a row, and the text that they give. */
export interface Fields {
    parts: HTMLElement[];
    read: () => string;
}

/** A key with the texts of its fields; "true" or "false" for a checkbox. */
export type StoredRow = [string, string[]];

interface Row {
    element: HTMLElement;
    fault: HTMLElement;
    read: () => string;
}

export class Rows {
    private readonly rows = new Map<string, Row>();
    /** The rows; a change of them is an event "change" here. */
    readonly list = document.createElement("div");
    private readonly select = document.createElement("select");
    private readonly button = document.createElement("button");
    private readonly general = document.createElement("p");
    private offered: [string, string][] = [];
    /** Stored rows whose keys are not offered yet. */
    private stored: StoredRow[] = [];

    /** `make` returns the fields of a key; `what` is a row, "limit". */
    constructor(host: HTMLElement, readonly table: string, private readonly what: string, private readonly make: (key: string, describe: string) => Fields) {
        this.select.setAttribute("aria-label", `Add a ${what}`);
        this.button.type = "button";
        this.button.textContent = "Add";
        this.button.setAttribute("aria-label", `Add this ${what}`);
        this.button.title = `Add a ${what}`;
        this.button.onclick = () => {
            this.add(this.select.value)?.querySelector<HTMLElement>(".field")?.focus();
            this.changed();
        };
        this.general.className = "fault";
        this.general.hidden = true;
        const bar = document.createElement("div");
        bar.className = "bar";
        bar.append(this.select, this.button);
        host.append(this.list, bar, this.general);
    }

    /** The rows as they are stored. */
    get state(): StoredRow[] {
        return [...[...this.rows].map(([key, { element }]): StoredRow => [key, inputs(element).map((input) => (input.type === "checkbox" ? String(input.checked) : input.value))]), ...this.stored];
    }

    /** Adds stored rows once their keys are offered. */
    restore(rows: StoredRow[]): void {
        this.stored = rows;
    }

    /** Offers keys with their titles; rows of other keys are removed. */
    offer(entries: [string, string][]): void {
        this.offered = entries;
        for (const key of [...this.rows.keys()]) if (!entries.some(([own]) => own === key)) this.remove(key);
        const isOffered = ([key]: StoredRow) => entries.some(([own]) => own === key);
        const found = this.stored.filter(isOffered);
        this.stored = this.stored.filter((row) => !isOffered(row));
        for (const [key, values] of found) this.add(key, values);
        this.refill();
    }

    get pairs(): [string, string][] {
        return [...this.rows].map(([key, row]) => [key, row.read()]);
    }

    /** Shows the faults of this table at their rows, and returns the others. */
    tell(faults: FieldFault[]): FieldFault[] {
        const own = faults.filter((fault) => fault.table === this.table || (!fault.table && fault.key === this.table));
        for (const [key, { element, fault }] of this.rows) {
            const words = own.filter((one) => one.key === key).map((one) => one.message);
            put(fault, words);
            for (const field of element.querySelectorAll(".field")) field.setAttribute("aria-invalid", String(words.length > 0));
        }
        put(this.general, own.filter((one) => !this.rows.has(one.key)).map((one) => one.message));
        return faults.filter((fault) => !own.includes(fault));
    }

    private changed(): void {
        this.list.dispatchEvent(new Event("change", { bubbles: true }));
    }

    /** Adds the row of a key, with the texts of its fields. */
    private add(key: string, values: string[] = []): HTMLElement | undefined {
        const title = this.offered.find(([own]) => own === key)?.[1];
        if (title === undefined || this.rows.has(key)) return undefined;
        const element = document.createElement("div");
        element.className = "row";
        element.setAttribute("role", "group");
        element.setAttribute("aria-label", `${title}, ${this.what}`);
        const fault = document.createElement("p");
        fault.className = "fault";
        fault.id = `search-${this.table}-${key.replaceAll(".", "-")}-fault`;
        fault.hidden = true;
        const { parts, read } = this.make(key, fault.id);
        const name = document.createElement("span");
        name.className = "name";
        name.textContent = title;
        name.title = key;
        const remove = document.createElement("button");
        remove.type = "button";
        remove.textContent = "×";
        remove.setAttribute("aria-label", `Remove ${title}, ${this.what}`);
        remove.onclick = () => {
            this.remove(key);
            this.refill();
            this.select.focus();
            this.changed();
        };
        element.append(name, remove, ...parts, fault);
        this.list.append(element);
        this.rows.set(key, { element, fault, read });
        inputs(element).forEach((input, k) => {
            if (values[k] === undefined) return;
            if (input.type === "checkbox") input.checked = values[k] === "true";
            else input.value = values[k];
        });
        this.refill();
        return element;
    }

    private remove(key: string): void {
        this.rows.get(key)?.element.remove();
        this.rows.delete(key);
    }

    private refill(): void {
        const free = this.offered.filter(([key]) => !this.rows.has(key));
        this.select.replaceChildren(...free.map(([key, title]) => new Option(title, key)));
        this.button.disabled = this.select.disabled = free.length === 0;
    }
}

function inputs(element: HTMLElement): HTMLInputElement[] {
    return [...element.querySelectorAll("input")];
}

/** Shows messages, or hides their place. */
export function put(place: HTMLElement, messages: string[]): void {
    const text = [...new Set(messages)].join(" ");
    if (place.textContent !== text) place.textContent = text;
    place.hidden = text === "";
}

/** A field of a row with a name for screen readers. */
export function field(name: string, text: string, describe: string, size = 7): HTMLInputElement {
    const input = document.createElement("input");
    input.className = "field";
    input.value = text;
    input.size = size;
    input.setAttribute("aria-label", name);
    input.setAttribute("aria-describedby", describe);
    return input;
}

/** A checkbox with its label. */
export function check(words: string, name: string, checked: boolean): { label: HTMLElement; box: HTMLInputElement } {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = checked;
    box.setAttribute("aria-label", name);
    label.append(box, ` ${words}`);
    return { label, box };
}

/** A text with a unit, where it is a bare number. */
export function withUnit(text: string, unit: string): string {
    const own = text.trim();
    return unit && /^[-+.\deE]+$/.test(own) ? `${own} ${unit}` : own;
}

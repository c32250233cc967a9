// Quantities that a design has: those of contact need a stop, the strain needs a patch.

import type { Quantity } from "./branches";
import type { Controls } from "./controls";

/** Table of the spec without which a quantity has no values. */
const NEEDED: Partial<Record<Quantity, string>> = { penetration: "stop", force: "stop", impact: "stop", displacement: "stop", strain: "patch" };

export class Quantities {
    private readonly select = document.getElementById("quantity") as HTMLSelectElement;
    private readonly grazings = document.getElementById("grazings")!.parentElement!;

    constructor(private readonly controls: Controls, choose: (quantity: Quantity) => void) {
        this.select.onchange = () => choose(this.select.value as Quantity);
    }

    /** Offers the quantities of a design; one that the design lacks gives way to the mean power. */
    offer(): void {
        const tables = new Set(this.controls.all.map(({ key }) => key.split(".")[0]));
        for (const option of this.select.options) {
            const table = NEEDED[option.value as Quantity];
            option.hidden = option.disabled = table !== undefined && !tables.has(table);
        }
        this.grazings.hidden = !tables.has("stop");
        if (!this.select.selectedOptions[0]?.disabled) return;
        this.select.value = "power";
        this.select.dispatchEvent(new Event("change"));
    }

    /** Chooses a quantity by its name; returns a message where the design does not have it. */
    choose(name: string): string | undefined {
        const option = [...this.select.options].find(({ value }) => value === name);
        if (!option) return `the link shows "${name}", which is no quantity of the response`;
        if (option.disabled) return `the link shows ${option.textContent}, which this design does not have`;
        if (this.select.value === name) return undefined;
        this.select.value = name;
        this.select.dispatchEvent(new Event("change"));
        return undefined;
    }

    /** Sets the words of a quantity. */
    name(quantity: Quantity, words: string): void {
        this.select.querySelector(`[value=${quantity}]`)!.textContent = words[0].toLowerCase() + words.slice(1);
    }
}

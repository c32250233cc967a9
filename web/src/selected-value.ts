// The selected point below the response, and a button that sets the key of the response to its value.

import type { Controls } from "./controls";
import type { Design } from "./design";
import type { Response } from "./response";

/** Digits of the value, as of the selected point in words. */
const DIGITS = 5;
const find = (id: string) => document.getElementById(id)!;

export class SelectedValue {
    private readonly button = find("use") as HTMLButtonElement;

    constructor(private readonly response: Response, private readonly controls: Controls, private readonly design: Design) {
        response.onPoint = (words) => this.show(words);
    }

    /** Sets the key to the value of the selected point. */
    use(): void {
        const [key, text] = this.value;
        if (text !== "") this.design.set(key, text);
    }

    /** The key of the response with the value of the selected point; "" where that is its present value. */
    private get value(): [string, string] {
        const { result, selectedValue } = this.response;
        const control = result && this.controls.find(result.over);
        if (!control || selectedValue === undefined) return ["", ""];
        const { key, value } = control;
        const [text, present] = [selectedValue, value].map((own) => this.controls.words(key, own, DIGITS));
        return [key, text === present ? "" : text];
    }

    private show(words: string): void {
        const [key, text] = this.value;
        find("selected").hidden = text === "";
        if (text === "") return;
        find("selected-words").textContent = `Selected: ${words}.`;
        this.button.textContent = `Use ${text}`;
        this.button.title = `Set ${key} to the value of the selected point (U)`;
    }
}

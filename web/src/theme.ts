// Colours of the library's plots (Okabe and Ito), distinguishable by colour-blind readers.

import { userStorage } from "./storage";

const THEME = "jounce-theme";
const SERIES = ["blue", "vermilion", "green", "purple", "orange", "sky"];

/** A colour of the page's style by its name. */
export function colour(name: string): string {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Colour of curve number `index`. */
export function nth(index: number): string {
    return colour(SERIES[index % SERIES.length]);
}

/** Colour of area number `index`: after six, mixtures with the background, so that none repeats. */
export function shade(index: number): string {
    const round = Math.floor(index / SERIES.length);
    return round === 0 ? nth(index) : `color-mix(in srgb, ${nth(index)} ${Math.round(100 * 0.6 ** round)}%, ${colour("ink")})`;
}

/** Light or dark: as the system specifies, until the user selects one. */
export class Theme {
    private readonly system = matchMedia("(prefers-color-scheme: dark)");
    private chosen = "light";

    constructor(private readonly button: HTMLButtonElement, private readonly changed: () => void) {
        this.put(userStorage?.getItem(THEME) ?? (this.system.matches ? "dark" : "light"));
        button.onclick = () => this.toggle();
        this.system.addEventListener("change", () => this.set(this.system.matches ? "dark" : "light"));
    }

    toggle(): void {
        const name = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
        userStorage?.setItem(THEME, name);
        this.set(name);
    }

    /** Shows a theme until the next call without one. */
    show(name = this.chosen): void {
        document.documentElement.dataset.theme = name;
        this.changed();
    }

    private set(name: string): void {
        this.put(name);
        this.changed();
    }

    private put(name: string): void {
        this.chosen = name;
        document.documentElement.dataset.theme = name;
        this.button.setAttribute("aria-pressed", String(name === "dark"));
        this.button.textContent = name === "dark" ? "Light" : "Dark";
    }
}

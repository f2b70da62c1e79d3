/** A field for text with numbered lines, colours, and marks at lines: mistakes, and verdicts. */

import { make } from "./page.js";

const TOML = /(#[^\n]*)|("""[\s\S]*?"""|"(?:[^"\\\n]|\\.)*"?|'[^'\n]*'?)|(^[ \t]*\[\[?[^\]\n]*\]\]?)|([\w.'-]+)(?=[ \t]*=)|(\b\d[\d_.eE]*\b)/gm;
const COLOURS = ["comment", "string", "table", "key", "number"];

/** @typedef {{line: number, column?: number|null, kind: "wrong"|"right"|"note", words: string}} LineMark */

export class Writing {
  /**
   * @param {HTMLElement} place
   * @param {{label: string, describedby?: string, toml?: boolean, rows?: number, changed: () => void}} options
   */
  constructor(place, { label, describedby, toml = false, rows = 0, changed }) {
    this.toml = toml;
    /** @type {LineMark[]} */
    this.marks = [];
    this.numbers = make("pre", { class: "numbers", "aria-hidden": "true" });
    this.shown = make("pre", { class: "shown", "aria-hidden": "true" });
    this.field = make("textarea", {
      "aria-label": label, "aria-describedby": describedby, spellcheck: "false", autocapitalize: "off",
      autocomplete: "off", autocorrect: "off", wrap: "off", rows: rows || null,
    });
    this.field.addEventListener("input", () => { this.draw(); changed(); });
    this.field.addEventListener("scroll", () => this.follow());
    place.replaceChildren(
      make("div", { class: rows ? "writing small-writing" : "writing" },
        this.numbers, make("div", { class: "field" }, this.shown, this.field)));
    this.draw();
  }

  get text() { return this.field.value; }

  set text(text) {
    this.field.value = text;
    this.marks = [];
    this.draw();
    this.field.scrollTop = this.field.scrollLeft = 0;
    this.follow();
  }

  /** @param {LineMark[]} marks */
  mark(marks) {
    this.marks = marks;
    this.field.setAttribute("aria-invalid", String(marks.some((m) => m.kind === "wrong")));
    this.draw();
  }

  /** Put the cursor at a line and column, both counted from 1. @param {number} line @param {number|null} [column] */
  go(line, column = 1) {
    const lines = this.text.split("\n");
    let at = 0;
    for (let i = 0; i < line - 1 && i < lines.length; i++) at += lines[i].length + 1;
    at += units(lines[line - 1] ?? "", (column ?? 1) - 1);
    this.field.focus();
    this.field.setSelectionRange(at, at);
    const height = parseFloat(getComputedStyle(this.field).lineHeight);
    if ((line + 1) * height > this.field.scrollTop + this.field.clientHeight || line * height < this.field.scrollTop) {
      this.field.scrollTop = Math.max(0, (line - 4) * height);
    }
  }

  follow() {
    this.shown.scrollTop = this.numbers.scrollTop = this.field.scrollTop;
    this.shown.scrollLeft = this.field.scrollLeft;
  }

  draw() {
    const lines = this.text.split("\n");
    const marked = new Map(this.marks.map((mark) => [mark.line, mark]));
    this.numbers.replaceChildren(...lines.map((_, i) => {
      const mark = marked.get(i + 1);
      return make("span", { class: mark ? `number ${mark.kind}` : "number", title: mark?.words }, `${i + 1}\n`);
    }));
    this.shown.replaceChildren(...this.coloured(), "\n");
    for (const mark of this.marks) this.underline(lines, mark);
    this.follow();
  }

  /** @returns {Node[]} */
  coloured() {
    if (!this.toml) return [document.createTextNode(this.text)];
    /** @type {Node[]} */
    const made = [];
    let at = 0;
    for (const found of this.text.matchAll(TOML)) {
      const kind = COLOURS[found.slice(1).findIndex((part) => part !== undefined)];
      made.push(document.createTextNode(this.text.slice(at, found.index)), make("span", { class: `tok-${kind}` }, found[0]));
      at = found.index + found[0].length;
    }
    made.push(document.createTextNode(this.text.slice(at)));
    return made;
  }

  /** Draw a line under the place of a mistake. @param {string[]} lines @param {LineMark} mark */
  underline(lines, mark) {
    if (mark.kind !== "wrong" || mark.line > lines.length) return;
    const line = lines[mark.line - 1];
    const start = mark.column ? Math.min(units(line, mark.column - 1), line.length) : line.search(/\S|$/);
    const length = mark.column ? (/^([\w.'"]+|.)/.exec(line.slice(start))?.[0].length ?? 1) : line.trim().length;
    const wave = make("span", { class: "wave" }, " ".repeat(Math.max(length, 1)));
    const row = make("span", { class: "wave-row" }, line.slice(0, start), wave);
    row.style.setProperty("--line", String(mark.line - 1));
    this.shown.append(row);
  }
}

/** The position of a character in a line, which errors count in characters and JavaScript in units of UTF-16.
 *  @param {string} line @param {number} characters */
function units(line, characters) {
  return [...line].slice(0, characters).join("").length;
}

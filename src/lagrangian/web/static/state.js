/** The open model, which all views share, and what listens to its changes. */

const KEPT = "lagrangian-model";

const EMPTY = `# A mass on a spring: write your own below
name = "mass on a spring"

[coordinates]
x = "position of the mass, from where the spring is relaxed"

[parameters]
m = "1 kg"
k = "40 N/m"

[[particle]]
mass = "m"
at = ["x", "0"]

[[spring]]
k = "k"
deflection = "x"

[simulate]
duration = "5 s"
initial = { x = "0.1 m" }
`;

/** @type {Set<() => void>} */
const listeners = new Set();

export const model = {
  name: "model.toml",
  text: "",
  /** The data of the last derivation without mistakes, and the text that it was made of. @type {any} */
  data: null,
  /** The SI unit of every parameter, coordinate and input of it. @type {Record<string, string>} */
  units: {},
  dataOf: "",
  /** Whether the person asked to derive this large model. */
  anyway: false,
};

/** @param {() => void} act */
export const whenOpened = (act) => listeners.add(act);

/** Open a model. @param {string} name @param {string} text */
export function open(name, text) {
  Object.assign(model, { name, text, data: null, dataOf: "", anyway: false });
  keep();
  for (const act of listeners) act();
}

export const openNew = () => open("model.toml", EMPTY);

/** Keep the model for when this tab is loaded again. */
export function keep() {
  sessionStorage.setItem(KEPT, JSON.stringify({ name: model.name, text: model.text }));
}

/** The model that this tab had before it was loaded again. */
export function kept() {
  const text = sessionStorage.getItem(KEPT);
  return text === null ? null : JSON.parse(text);
}

/** The arguments that every request about the model has. */
export const about = () => ({ model: model.text, name: model.name, anyway: model.anyway });

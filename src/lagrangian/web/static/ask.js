/** Requests to the server of this app, with the token that stood after # in the address. */

const KEPT = "lagrangian-token";

/** @typedef {{code?: string|null, what: string, element?: string|null, line?: number|null, column?: number|null,
 *             fix?: string|null, message?: string, anyway?: boolean, status?: number}} Trouble */

/** Take the token out of the address, or the one that this tab had before it was loaded again. */
export function takeToken() {
  const given = location.hash.slice(1);
  if (/^[\w-]{32}$/.test(given)) {
    sessionStorage.setItem(KEPT, given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem(KEPT) !== null;
}

/** Why a request had no answer. */
export class Lost extends Error {}

/**
 * @param {string} verb
 * @param {object} [data]
 * @param {AbortSignal} [signal]
 */
function post(verb, data = {}, signal = undefined) {
  return fetch(`/api/${verb}`, {
    method: "POST",
    headers: { "content-type": "application/json", "x-lagrangian-token": sessionStorage.getItem(KEPT) ?? "" },
    body: JSON.stringify(data),
    signal,
  }).catch((error) => {
    if (signal?.aborted) throw error;
    throw new Lost("The app does not answer. Was it ended in the terminal? Start it again with: lagrangian web");
  });
}

/**
 * Ask for something; the answer of the server, in which `error` says what is wrong.
 * @param {string} verb
 * @param {object} [data]
 * @param {AbortSignal} [signal]
 * @returns {Promise<any>}
 */
export async function ask(verb, data, signal) {
  const response = await post(verb, data, signal);
  const answer = await response.json();
  if (response.status === 401) throw new Lost(`${answer.error.what[0].toUpperCase()}${answer.error.what.slice(1)}.`);
  const lost = document.getElementById("lost");
  if (lost) lost.hidden = true;
  if (answer.error) answer.error.status = response.status;
  return answer;
}

/**
 * Ask for something that arrives in parts, a line of JSON each.
 * @param {string} verb
 * @param {object} data
 * @param {AbortSignal} signal
 * @param {(message: any) => void} take
 */
export async function follow(verb, data, signal, take) {
  const response = await post(verb, data, signal);
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { value, done } = await reader.read();
    rest += value ?? "";
    const lines = rest.split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) if (line) take(JSON.parse(line));
    if (done) break;
  }
  if (rest) take(JSON.parse(rest));
}

/** Sentences of the server on the page. */

import { h, type Child, type Props } from "../dom.ts";
import { trText } from "./index.ts";

/** Words in a row, not a name or a value. */
const SENTENCE = /[a-z]{2,} [a-z]/i;

/** What a refusal says: a sentence of the server in the language of the page, or marked as English; one of the page as it is. */
export function refusedWith<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props,
  refusal: { of_server: boolean },
  text: string,
): HTMLElementTagNameMap[K] {
  return refusal.of_server ? told(tag, props, text) : h(tag, props, text);
}

/** What the server says, in the language of the page; what no dictionary has stays, and is marked as English. */
export function told<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props,
  text: string,
  show: (text: string) => Child = (said) => said,
): HTMLElementTagNameMap[K] {
  const said = trText(text);
  return h(tag, said === text && SENTENCE.test(text) ? { ...props, lang: "en" } : props, show(said));
}

// A line of JSON in coloured pieces. JSON's strings end on the line they begin on, so a line needs
// no memory of the one before. It colours, it does not judge: what it does not know stays plain.

const pattern =
  /("(?:[^"\\]|\\.)*"?)(\s*:)?|(-?\d[\d.eE+-]*)|\b(true|false|null)\b|([{}[\],:]+)|[^"\d{}[\],:tfn-]+|./g;

/// Longer lines stay plain: their pieces would cost more than their colours are worth.
export const longest_painted = 2000;

/// [{kind, text}], whose texts add up to `line`; kind is "key", "string", "number", "literal",
/// "mark" or "plain".
export function tokensOf(line) {
  if (line.length > longest_painted) return [{ kind: "plain", text: line }];
  const tokens = [];
  for (const [text, string, colon, number, literal, mark] of line.matchAll(pattern)) {
    if (colon) tokens.push({ kind: "key", text: string }, { kind: "mark", text: colon });
    else if (string) tokens.push({ kind: "string", text });
    else if (number) tokens.push({ kind: "number", text });
    else if (literal) tokens.push({ kind: "literal", text });
    else if (mark) tokens.push({ kind: "mark", text });
    else tokens.push({ kind: "plain", text });
  }
  return tokens;
}

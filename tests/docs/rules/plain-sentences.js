// A textlint rule: no sentence is longer than 30 words, and none begins in a way that hides its subject. Code spans
// and numbers are no words, and in a table a semicolon ends a sentence, since cells hold lists. Questions may begin
// with "What" and "Who".
import { split } from "sentence-splitter";
import { StringSource } from "textlint-util-to-string";

const kMostWords = 30;
const kBanned = ["That of", "Those of", "Of", "So is", "So are", "So it is", "What", "Whatever", "Who", "Whoever", "Nor", "Likewise"];

const banned = new RegExp(`^(?:${kBanned.join("|")})\\b`);
const isWord = (token) => /\p{L}/u.test(token);

// The library leaves "in 2026. The next" and "at 30 %. The next" whole.
const kEnd = /(?<=[\d%)0])\.\s+(?=\p{Lu}|0)/u;

function* sentencesOf(text, separators) {
    for (const part of split(text)) {
        if (part.type !== "Sentence") continue;
        let at = part.range[0];
        for (const sentence of part.raw.split(separators)) {
            yield { text: sentence.trim(), at };
            at += sentence.length;
        }
    }
}

export default function plainSentences(context) {
    const { Syntax, RuleError, report, locator } = context;
    const checkWith = (separators) => (node) => {
        // Code becomes digits of its length, so that it is no word and places stay where they are.
        const replacer = ({ node: part, maskValue }) => (part.type === Syntax.Code ? maskValue("0") : undefined);
        const source = new StringSource(node, { replacer });
        for (const sentence of sentencesOf(source.toString(), separators)) {
            const words = sentence.text.split(/\s+/).filter(isWord).length;
            const index = source.originalIndexFromIndex(sentence.at) ?? 0;
            const complain = (what) =>
                report(node, new RuleError(`${what}: ${sentence.text.slice(0, 80)}`, { padding: locator.at(index) }));
            if (words > kMostWords) complain(`${words} words, at most ${kMostWords}`);
            if (banned.test(sentence.text) && !sentence.text.endsWith("?")) complain("banned opening");
        }
    };
    return {
        [Syntax.Paragraph]: checkWith(kEnd),
        [Syntax.TableCell ?? "TableCell"]: checkWith(new RegExp(`${kEnd.source}|;`, "u")),
    };
}

// The results that a command has put into its report.

/**
 * The results in a script element's text, of `schema`, as `froxel ${command} --report` writes them. Throws an Error for
 * people: the empty template, another schema.
 */
export function readReport<T extends { readonly schema: string }>(text: string, schema: T['schema'], command: string): T {
  const results = JSON.parse(text) as T | null;
  if (results === null) {
    throw new Error(`This is the empty template: \`froxel ${command} --report FILE.html\` fills it with results.`);
  }
  if (results.schema !== schema) {
    throw new Error(`The results are of schema "${results.schema}"; this page reads "${schema}".`);
  }
  return results;
}

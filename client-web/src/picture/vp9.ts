// What WebCodecs has to know of the protocol's VP9.

// Of the level, which bounds size and rate: the highest that WebCodecs names.
const kLevel = '62';

/** WebCodecs' name of a profile with 8 bits. */
const vp9Name = (profile: number): string => `vp09.0${profile}.${kLevel}.08`;

/** By the profile in a frame's header. */
export function vp9NameOf([first = 0]: Uint8Array): string {
  return vp9Name(((first >> 5) & 1) | ((first >> 3) & 2));
}

/** Whether this browser does, with both chroma formats; never outside secure contexts. */
export async function decodesVp9(): Promise<boolean> {
  if (typeof VideoDecoder === 'undefined') return false;
  const answers = [0, 1].map((profile) =>
    VideoDecoder.isConfigSupported({ codec: vp9Name(profile), optimizeForLatency: true }).then(
      ({ supported }) => supported === true,
      () => false,
    ),
  );
  return (await Promise.all(answers)).every(Boolean);
}

// What is to be known of single files.

export interface Note {
  /** Lit by the file's own lights, not by our lamps. */
  readonly ownLights?: true;
  /** Why the pictures differ. */
  readonly why?: string;
}

// Measured by taking them out of three.js' shaders.
const kScattering = 'rough metal: three.js restores light that scatters more than once';
const kRounding = 'three.js increases the roughness of curved surfaces';

const kThroughRough = 'three.js lets no lamp shine through rough glass';

const kNotes: Readonly<Record<string, Note>> = {
  alien: { why: kScattering },
  cakeBirthday: { why: kScattering },
  cat: { why: kRounding },
  love: { why: `${kRounding}; it lets no lamp shine through rough glass` },
  metallic_roughness: { why: kScattering },
  punctual: { ownLights: true, why: "three.js lets a spot's edge fall off by another curve" },
  transmission: { why: kThroughRough },
  unlit: { why: 'three.js tone-maps unlit surfaces' },
  specular: { why: 'three.js reduces each channel of diffuse light by its own reflection' },
};

export const noteOf = (name: string): Note => kNotes[name] ?? {};

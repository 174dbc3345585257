// What is to be known of single files.

export interface Note {
  /** Lit by the file's own lights, not by our lamps. */
  readonly ownLights?: true;
  /** Why the pictures differ. */
  readonly why?: string;
}

// Measured by taking them out of three.js' shaders.
const kScattering = 'rough metal: three.js gives back what it would lose by scattering more than once';
const kRounding = 'three.js takes curved surfaces for rougher than the file has them';

const kNotes: Readonly<Record<string, Note>> = {
  'glass-table': { why: 'Froxel has no KHR_materials_transmission' },
  alien: { why: kScattering },
  cakeBirthday: { why: kScattering },
  cat: { why: kRounding },
  love: { why: 'Froxel has no KHR_materials_transmission' },
  metallic_roughness: { why: kScattering },
  punctual: { ownLights: true, why: "three.js lets a spot's edge fall off by another curve" },
  unlit: { why: 'three.js tone-maps unlit surfaces' },
  specular: { why: 'under coloured reflections three.js takes each channel by itself from diffuse light' },
};

export const noteOf = (name: string): Note => kNotes[name] ?? {};

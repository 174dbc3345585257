// Names of settings as people read them.

/** `clustered_deferred` as `clustered deferred`. */
export const words = (name: string): string => name.replaceAll('_', ' ');

// Asks the server for the scene that is wanted.

import type { Sender } from './settings_sync';
import type { Store } from './store';

export function keepScene(store: Store, sender: Sender): void {
  store.listen(({ link, wantedScene, server, sceneLoading }, before) => {
    if (link.phase !== 'live' || wantedScene === null) return;
    if (wantedScene === before.wantedScene && before.link.phase === 'live') return;
    const isShown = wantedScene === server?.scene?.id;
    if (isShown && !sceneLoading) return; // there is nothing to call off
    sender.send({ case: 'selectScene', value: { scene: wantedScene } });
  });
}

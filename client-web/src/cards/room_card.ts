// The card that says who is in the room, with the buttons that move control about.

import { element, make } from '../core/dom';
import { isAsking, roomText, type Member, type Room } from '../state/room';

export interface RoomActions {
  requestControl(): void;
  releaseControl(): void;
  giveControl(memberId: bigint): void;
}

export class RoomCard {
  private readonly card = element('room', HTMLElement);
  private readonly text = element('room-text', HTMLElement);
  private readonly request = element('room-request', HTMLButtonElement);
  private readonly release = element('room-release', HTMLButtonElement);
  private readonly list = element('room-members', HTMLUListElement);
  private shown: Room | null = null;

  constructor(private readonly actions: RoomActions) {
    this.request.addEventListener('click', () => actions.requestControl());
    this.release.addEventListener('click', () => actions.releaseControl());
  }

  show(room: Room | null): void {
    if (room === this.shown) return;
    this.shown = room;
    this.card.hidden = room === null;
    if (!room) return;
    const controls = room.controller === room.you;
    const asks = isAsking(room);
    this.text.textContent = roomText(room);
    this.request.hidden = controls || asks;
    this.request.textContent = room.controller === 0n ? 'Take control' : 'Ask for control';
    this.release.hidden = !controls && !asks;
    this.release.textContent = controls ? 'Release control' : 'Ask no more';
    const rows = room.members.map((member) => this.row(room, member));
    const more = room.memberCount - room.members.length;
    if (more > 0) rows.push(make('li', `and ${more} more`));
    this.list.replaceChildren(...rows);
  }

  private row(room: Room, member: Member): HTMLLIElement {
    const marks = [
      member.id === room.you ? 'you' : '',
      member.id === room.controller ? 'controls' : '',
      member.asking ? 'asks for control' : '',
      member.away ? 'connection lost' : '',
    ].filter((mark) => mark !== '');
    const row = make('li', [`Viewer ${member.id}`, ...marks].join(' · '));
    row.title = member.name;
    if (room.controller === room.you && member.id !== room.you && !member.away) {
      const give = make('button', 'Give control');
      give.type = 'button';
      give.title = 'Hand control of this room to this viewer';
      give.addEventListener('click', () => this.actions.giveControl(member.id));
      row.append(give);
    }
    return row;
  }
}

// The card of the room: opens one, says who is there, and has the buttons that move control about.

import { element, make } from '../core/dom';
import { isAsking, roomText, type Member, type Room } from '../state/room';

export interface RoomActions {
  requestControl(): void;
  releaseControl(): void;
  giveControl(memberId: bigint): void;
}

/** What changes the page's address. */
export interface RoomDoors {
  /** Goes there with this view; empty: goes on alone. */
  enterRoom(name: string): void;
  copyRoomLink(name: string): void;
}

const kAlone = 'A room is one view for everybody who opens its link. One viewer controls it at a time.';

export class RoomCard {
  private readonly card = element('room', HTMLElement);
  private readonly text = element('room-text', HTMLElement);
  private readonly form = element('room-form', HTMLFormElement);
  private readonly name = element('room-name', HTMLInputElement);
  private readonly buttons = element('room-buttons', HTMLElement);
  private readonly request = element('room-request', HTMLButtonElement);
  private readonly release = element('room-release', HTMLButtonElement);
  private readonly list = element('room-members', HTMLUListElement);
  private shown: Room | null = null;
  private open: boolean | null = null; // null: nobody chose, so it is where there is a room

  constructor(
    private readonly actions: RoomActions,
    doors: RoomDoors,
  ) {
    this.request.addEventListener('click', () => actions.requestControl());
    this.release.addEventListener('click', () => actions.releaseControl());
    element('room-link', HTMLButtonElement).addEventListener('click', () => doors.copyRoomLink(this.shown?.name ?? ''));
    element('room-leave', HTMLButtonElement).addEventListener('click', () => doors.enterRoom(''));
    this.form.addEventListener('submit', (event) => {
      event.preventDefault();
      doors.enterRoom(this.name.value);
    });
    this.draw(null);
  }

  toggle(): void {
    this.open = this.card.hidden;
    this.card.hidden = !this.open;
    if (!this.open || this.shown) return;
    this.name.value = `room-${Math.random().toString(36).slice(2, 8)}`;
    this.name.select();
    this.name.focus();
  }

  show(room: Room | null): void {
    if (room === this.shown) return;
    this.shown = room;
    this.card.hidden = !(this.open ?? room !== null);
    this.draw(room);
  }

  private draw(room: Room | null): void {
    this.form.hidden = room !== null;
    this.buttons.hidden = this.list.hidden = room === null;
    this.text.textContent = room ? roomText(room) : kAlone;
    if (!room) return;
    const controls = room.controller === room.you;
    const asks = isAsking(room);
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

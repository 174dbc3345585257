// The scene's own animations: which one plays, how, and where it stands.

import { element, make } from '../core/dom';
import { numberedName, tidy } from '../core/format';
import { Repeat, RepeatSchema } from '../gen/froxel/v1/common_pb';
import type { SceneAnimation } from '../gen/froxel/v1/server_pb';
import { choicesOf } from '../protocol/schema_names';
import type { AppState } from '../state/app_state';
import { mayControl } from '../state/room';

type Settings = NonNullable<AppState['settings']>;
type How = Pick<
  Settings,
  'animation' | 'animationPlaying' | 'animationSpeed' | 'animationRepeat' | 'animationTime'
>;

export interface AnimationActions {
  edit(patch: Partial<How>): void;
}

/** Of the list, the first for none. */
export const namesOf = (animations: readonly Pick<SceneAnimation, 'name'>[]): string[] => [
  'none',
  ...animations.map(({ name }, index) => numberedName(name, index)),
];

/** "0:01.5 / 1:02.0" */
export function clockText(timeS: number, durationS: number): string {
  const text = (seconds: number): string => {
    const tenths = Math.floor(seconds * 10 + 1e-6);
    const rest = ((tenths % 600) / 10).toFixed(1).padStart(4, '0');
    return `${Math.floor(tenths / 600)}:${rest}`;
  };
  return `${text(timeS)} / ${text(durationS)}`;
}

/** Whether it has come to its end, and stays there. */
export function hasEnded(how: How, timeS: number, durationS: number): boolean {
  if (how.animationRepeat !== Repeat.ONCE) return false;
  return how.animationSpeed < 0 ? timeS <= 0 : timeS >= durationS;
}

/** The edit of the button: pauses, goes on, or begins anew after the end. */
export function toggled(how: How, timeS: number, durationS: number): Partial<How> {
  const ended = hasEnded(how, timeS, durationS);
  if (how.animationPlaying && !ended) return { animationPlaying: false };
  const start = how.animationSpeed < 0 ? durationS : 0;
  return { animationPlaying: true, ...(ended && { animationTime: start }) };
}

export class AnimationCard {
  private readonly card = element('animation', HTMLElement);
  private readonly play = element('animation-play', HTMLButtonElement);
  private readonly time = element('animation-time', HTMLInputElement);
  private readonly clock = element('animation-clock', HTMLElement);
  private readonly name = element('animation-name', HTMLSelectElement);
  private readonly repeat = element('animation-repeat', HTMLSelectElement);
  private readonly speed = element('animation-speed', HTMLInputElement);
  private animations: readonly SceneAnimation[] = [];
  private shown: Settings | null = null;
  private timeS = 0; // of the picture
  private scrubbed = false; // playing stops while the time line is held

  constructor(private readonly actions: AnimationActions) {
    this.play.addEventListener('click', () => this.toggle());
    this.time.addEventListener('input', () => this.scrub());
    this.time.addEventListener('change', () => this.letGo());
    // Its time is another one's now.
    this.name.addEventListener('change', () =>
      actions.edit({ animation: this.name.selectedIndex, animationTime: null }),
    );
    this.repeat.addEventListener('change', () =>
      actions.edit({ animationRepeat: Number(this.repeat.value) }),
    );
    this.speed.addEventListener('change', () => {
      if (Number.isFinite(this.speed.valueAsNumber)) {
        actions.edit({ animationSpeed: this.speed.valueAsNumber });
      }
    });
    this.repeat.replaceChildren(
      ...choicesOf(RepeatSchema).map(({ name, value }) =>
        this.option(name.replaceAll('_', ' '), String(value)),
      ),
    );
  }

  show({ server, settings, room }: AppState): void {
    const animations = server?.scene?.animations ?? [];
    this.card.hidden = animations.length === 0 || !settings;
    if (!settings || animations.length === 0) return;
    this.card.inert = !mayControl(room);
    if (animations !== this.animations) {
      this.animations = animations;
      this.name.replaceChildren(...namesOf(animations).map((name) => this.option(name)));
    }
    if (settings === this.shown) return;
    this.shown = settings;
    this.name.selectedIndex = settings.animation;
    this.repeat.value = String(settings.animationRepeat);
    if (document.activeElement !== this.speed) this.speed.value = String(tidy(settings.animationSpeed));
    this.play.disabled = settings.animation === 0;
    this.time.disabled = settings.animation === 0;
    this.time.max = String(this.durationS());
    this.showTime(settings.animationTime ?? this.timeS);
  }

  /** Of the picture that is shown; none where no animation is chosen. */
  showTime(timeS: number | undefined): void {
    if (!this.shown || timeS === undefined) return;
    this.timeS = timeS;
    const durationS = this.durationS();
    const goesOn = this.shown.animationPlaying && !hasEnded(this.shown, timeS, durationS);
    this.play.setAttribute('aria-pressed', String(goesOn));
    if (this.scrubbed) return;
    this.time.value = String(timeS);
    this.clock.textContent = clockText(timeS, durationS);
  }

  toggle(): void {
    if (this.shown && this.shown.animation > 0) {
      this.actions.edit(toggled(this.shown, this.timeS, this.durationS()));
    }
  }

  private scrub(): void {
    const animationTime = this.time.valueAsNumber;
    this.clock.textContent = clockText(animationTime, this.durationS());
    this.scrubbed ||= this.shown?.animationPlaying ?? false;
    this.actions.edit({ animationPlaying: false, animationTime });
  }

  private letGo(): void {
    if (this.scrubbed) this.actions.edit({ animationPlaying: true });
    this.scrubbed = false;
  }

  private durationS(): number {
    return this.animations[(this.shown?.animation ?? 0) - 1]?.durationS ?? 0;
  }

  private option(text: string, value = text): HTMLOptionElement {
    const option = make('option', text);
    option.value = value;
    return option;
  }
}

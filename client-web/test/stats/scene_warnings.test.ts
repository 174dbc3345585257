import { create } from '@bufbuild/protobuf';
import { describe, expect, it } from 'vitest';

import {
  SceneInfoSchema,
  SceneWarningSchema,
  Severity,
  type SceneInfo,
} from '../../src/gen/froxel/v1/server_pb';
import { warningsTitle, warningTip } from '../../src/stats/scene_warnings';

function sceneWith(severities: readonly Severity[], left = 0n): SceneInfo {
  const warnings = severities.map((severity) => create(SceneWarningSchema, { severity }));
  return create(SceneInfoSchema, { warnings, warningsLeftOut: left });
}

describe('scene warnings', () => {
  it('Title_CountsWarningsRemarksAndTheRest', () => {
    const { WARNING, INFORMATION } = Severity;
    expect(warningsTitle(sceneWith([WARNING]))).toBe("The scene's file: 1 warning");
    expect(warningsTitle(sceneWith([WARNING, WARNING, INFORMATION], 4n))).toBe(
      "The scene's file: 2 warnings, 1 remark, 4 more",
    );
    expect(warningsTitle(sceneWith([INFORMATION, INFORMATION]))).toBe("The scene's file: 2 remarks");
  });

  it('Tip_NamesCodeAndPlace', () => {
    const there = create(SceneWarningSchema, { code: 'SCENE_NON_ROOT_NODE', pointer: '/scenes/0' });
    expect(warningTip(there)).toBe('SCENE_NON_ROOT_NODE at /scenes/0');
    expect(warningTip(create(SceneWarningSchema, { code: 'NO_SCENE' }))).toBe('NO_SCENE');
  });
});

import { expect, test } from "vitest";
import { cells } from "../../src/scene/workspace";
import { OBSTACLE } from "./recorded";

test("a box that is not left is put together from its sides", () => {
  const side = (name: string, min: number, max: number | null) => ({ ...OBSTACLE, name, type: "coordinate", min, max });
  const whole = [side("cell/x", 0, 1), side("cell/y", -1, 1), side("cell/z", 0.5, 1.5)];
  const open = [side("open/x", 0, 1), side("open/y", 0, 1), side("open/z", 0, null)];
  const others = [OBSTACLE, side("table", 0, 1), { ...side("other/x", 0, 1), type: "height" }];
  const [box, ...rest] = cells([...others, ...whole, ...open]);
  expect(rest).toEqual([]);
  expect(box).toEqual({ name: "cell", sides: whole, center_m: [0.5, 0, 1], size_m: [1, 2, 1] });
});

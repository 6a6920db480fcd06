// A scene with fifty obstacles, to see how much script a frame takes.

export const OBSTACLES = 50;

/** Fifty balls around the way of the tool. */
export function crowded(): string {
  const balls = Array.from({ length: OBSTACLES }, (_, nth) => {
    const [column, row] = [nth % 10, Math.floor(nth / 10)];
    const point = [0.2 + 0.06 * row, -0.45 + 0.1 * column, -0.28];
    return `[[task]]\nname = "ball_${nth}"\ntype = "distance"\npoint_m = [${point.join(", ")}]\nmin = 0.05\n`;
  });
  return `title = "Fifty obstacles"
[robot]
model = "ur5-paper"
q0_deg = [-48, -158, -108, -90, -85, 0]
[control]
duration_s = 30
${balls.join("")}
[[task]]
name = "position"
type = "position"
waypoints_m = [[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]]
acceptance_m = 0.02
gain_per_s = 0.3
`;
}

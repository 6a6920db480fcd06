// What is seen through: regions, obstacles, cones. Clear in the middle and firm at the rim, so that a
// shape is read from its outline and what is behind it stays visible.

import { Color, DoubleSide, FrontSide, LineBasicMaterial, ShaderMaterial } from "three";

const VERTEX = /* glsl */ `
  varying vec3 vNormal;
  varying vec3 vView;
  void main() {
    #ifdef USE_INSTANCING
      // Of balls, whose normals this leaves as they are.
      vec4 seen = modelViewMatrix * instanceMatrix * vec4(position, 1.0);
    #else
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
    #endif
    vNormal = normalMatrix * normal;
    vView = -seen.xyz;
    gl_Position = projectionMatrix * seen;
  }
`;

const FRAGMENT = /* glsl */ `
  uniform vec3 colour;
  uniform float body;
  uniform float rim;
  varying vec3 vNormal;
  varying vec3 vView;
  void main() {
    float facing = abs(dot(normalize(vNormal), normalize(vView)));
    float edge = pow(1.0 - facing, 2.2);
    vec3 lit = colour * (0.82 + 0.18 * facing);
    gl_FragColor = vec4(lit, clamp(body + rim * edge, 0.0, 1.0));
    #include <colorspace_fragment>
  }
`;

/** A `shell` is open and seen from both sides; a `sheet` is flat, and all rim where it is seen askew; a `cell`
    has everything in it, and is nearly nothing but its edges. */
export type Kind = "solid" | "shell" | "sheet" | "cell";

/** How much something wants to be seen: `thin` is what is behind everything else. */
export type State = "rest" | "thin" | "lit" | "chosen";

export function isBright(state: State): boolean {
  return state === "lit" || state === "chosen";
}

export class Glass extends ShaderMaterial {
  constructor(private readonly kind: Kind = "solid") {
    super({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { colour: { value: new Color() }, body: { value: 0.1 }, rim: { value: 0.5 } },
      transparent: true,
      depthWrite: false,
      side: kind === "solid" ? FrontSide : DoubleSide,
    });
  }

  /** `strength` is 1 of what is at rest. */
  paint(colour: string, strength: number, isThin = false): void {
    (this.uniforms["colour"]!.value as Color).set(colour);
    const firm = { solid: 0.11, shell: 0.11, sheet: 0.06, cell: 0.012 }[this.kind];
    this.uniforms["body"]!.value = Math.min(firm, isThin ? 0.035 : firm) * strength;
    const isFlat = this.kind === "sheet" || this.kind === "cell";
    const rim = isFlat ? 0.02 : isThin ? 0.16 : 0.42;
    this.uniforms["rim"]!.value = Math.min(0.9, rim * strength);
  }
}

/** Materials that many things share: what is drawn with the same one costs little. */
export class Glasses {
  private readonly glasses = new Map<string, Glass>();
  private readonly edges = new Map<State, LineBasicMaterial>();

  glass(kind: Kind, state: State): Glass {
    const key = `${kind} ${state}`;
    const known = this.glasses.get(key) ?? new Glass(kind);
    this.glasses.set(key, known);
    return known;
  }

  edge(state: State): LineBasicMaterial {
    const known = this.edges.get(state) ?? new LineBasicMaterial({ transparent: true });
    this.edges.set(state, known);
    return known;
  }

  /** Colours of what is at rest, of what is active, and of what somebody points at. */
  paint(rest: string, lit: string, chosen: string): void {
    const colours = { rest, thin: rest, lit, chosen };
    for (const [key, glass] of this.glasses) {
      const state = key.split(" ")[1] as State;
      glass.paint(colours[state], isBright(state) ? 2.6 : 1, state === "thin");
    }
    for (const [state, edge] of this.edges) {
      edge.color.set(colours[state]);
      edge.opacity = isBright(state) ? 0.9 : 0.35;
    }
  }
}

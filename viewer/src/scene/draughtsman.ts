// Draws a scene as well as the machine does it in time. Where software draws, what moves is drawn roughly,
// several times as often for it, and finely as soon as it stands still.

import { type Camera, PCFShadowMap, type Scene, WebGLRenderer } from "three";

/** How long a scene stands still before it is drawn finely [ms]. */
const STILL = 350;
/** Pixels drawn for one that is seen, across and down, which smooths edges as a graphics card does. */
const FINE = 2;
const MOST = 2;
/** Of a large window fewer: more pixels than this software draws for so long that hands have to wait. */
const PIXELS = 8e6;
/** What drivers without a graphics card call themselves. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|lavapipe|basic render|software/i;

export class Draughtsman {
  readonly canvas: HTMLCanvasElement;
  private readonly isSlow = isDrawnInSoftware();
  private readonly renderer: WebGLRenderer;
  private isRough: boolean;
  private drawn_ms = 0;
  /** Of the picture as it is seen [px]. */
  private area = 1;

  /** `throwShadows` is told whether there are shadows from now on. Throws where there is no WebGL. */
  constructor(private readonly throwShadows: (are: boolean) => void) {
    this.renderer = new WebGLRenderer({ antialias: !this.isSlow });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.canvas = this.renderer.domElement;
    this.isRough = this.isSlow;
    throwShadows(!this.isRough);
  }

  paint(background: string): void {
    this.renderer.setClearColor(background);
  }

  resize(width: number, height: number): void {
    this.area = width * height;
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height);
  }

  /** Draws what has changed. */
  draw(scene: Scene, camera: Camera): void {
    this.become(this.isSlow);
    this.renderer.render(scene, camera);
    this.drawn_ms = performance.now();
  }

  /** Draws finely what was drawn roughly, once it has not changed for a while. */
  finish(scene: Scene, camera: Camera): void {
    if (!this.isRough || performance.now() - this.drawn_ms < STILL) return;
    this.become(false);
    this.renderer.render(scene, camera);
  }

  private get ratio(): number {
    if (!this.isSlow) return Math.min(window.devicePixelRatio, MOST);
    return this.isRough ? 1 : Math.min(FINE, Math.max(1, Math.sqrt(PIXELS / this.area)));
  }

  private become(isRough: boolean): void {
    if (isRough === this.isRough) return;
    this.isRough = isRough;
    this.renderer.setPixelRatio(this.ratio);
    this.throwShadows(!isRough);
  }
}

/** Asked of a picture of its own: whether edges are smoothed is settled before a renderer can be asked. */
function isDrawnInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return false;
  const driver = context.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER;
  const name = String(context.getParameter(driver));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}

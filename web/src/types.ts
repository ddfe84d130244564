// Parts of the program's results that both pages show: summary.json as it stands (SI), and lists of numbers.

/// Numbers, some of them missing.
export type Values = (number|null)[];
export type Span = [low: number, high: number];
export type BodyName = "rail"|"wheel";

export interface StressMaximum {
  value_Pa: number;
  x_m: number|null;
  y_m: number|null;
  depth_m: number|null;
  error_Pa?: number|null;
}
export type Measure = "von_mises_max"|"sigma1_max";
export type Zones = Record<string, Record<Measure, StressMaximum|null>|null>;

/// By what the elastic stress may be multiplied; null where it was not computed or nothing decides.
export type Factors = Record<"first_yield"|"wandering"|"single_track"|"upper"|"kinematic", number|null>;

export interface ZoneShakedown {
  zone: string;
  depth_m: number|null;
  factors: Factors;
  verdict?: string;
}

export interface BodyShakedown {
  body: string;
  factors: Factors;
  zones?: ZoneShakedown[];
  notes: string[];
}

/// The largest principal stress of a zone.
export interface PrincipalZone {
  zone: string;
  sigma1_max_Pa: number|null;
  depth_m: number|null;
  share_of_tensile_strength: number|null;
  critical_flaw_m: number|null;
  thickness_m?: number|null;  // of a layer
}

export interface InterfaceStress {
  above: string;
  below: string;
  depth_m: number|null;
  tension_Pa: number|null;
  shear_Pa: number|null;
  shear_range_Pa: number|null;
  delamination: number|null;
}

export interface BodyFatigue {
  body: string;
  zones?: PrincipalZone[];
  interfaces?: InterfaceStress[];
}

/// What yielded; place: of the largest accumulated plastic strain.
export interface PlasticNumbers {
  strain: number|null;
  accumulated: number|null;
  elements: number|null;
  x_m: number|null;
  y_m: number|null;
  depth_m: number|null;
  work_J: number|null;
  dissipated_J: number|null;
  body: BodyName|null;
  zone: string|null;
}

/// Stress when the wheel has gone; none: why it is not available.
export interface ResidualNumbers {
  none: string|null;
  sigma_x_min_Pa?: number;
  sigma_y_min_Pa?: number;
  uneven?: number;
}

export interface Summary {
  title?: string;
  state?: string;  // of a transient: which of its states this is
  position_m: number|null;
  contact: Record<string, number|null>;
  patches?: Record<string, number|null>[];  // where the wheel touches at several places
  stress: Record<BodyName, Zones>;
  damage?: Record<string, number|null>;
  shakedown?: {
    factors: Factors;
    verdict?: string;
    fails_by?: string[];
    answer?: {lasts: string; title: string; tone: string; zone: string; decides: string; reason: string};
    bodies: BodyShakedown[];
  };
  fatigue?: BodyFatigue[];
  crack?: Record<string, number|null>;
  interface?: Record<string, number|null>;
  plastic?: PlasticNumbers;
  residual?: ResidualNumbers;
  run: Record<string, number|string|null>;
}

export interface Unit {
  si: string;
  shown: string;   // "MPa", "%", "inside|outside" for 0 and 1, "" for a plain number
  factor: number;  // SI to what is shown
}

/// A number of summary.json and how it is written.
export interface Quantity {
  path: string;  // "contact/p_max_Pa"
  name: string;
  label: string;  // short, as in the head of a table
  unit: Unit;
  digits: number;  // significant ones
  shown: boolean;
  round_off: {share: number; of: string[]}|null;  // below share times the numbers at these paths nothing is a result
  error_bar?: string|null;                        // path of its bar
  comparable: boolean;  // false: a small remainder, or another thing in the other engine: no difference is shown
}

/// The program's list of results, as it stands in every page: a new number needs no new script.
export interface NumberWords {
  numbers: Quantity[];
  zones: {key: string; name: string}[];
  measures: {key: Measure; name: string}[];
}

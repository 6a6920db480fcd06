//! What the driver puts on the wire and how it takes what comes back, against a controller that
//! only records.

mod generator;
mod stub;

mod driver {
    mod driving;
    mod fault;
    mod noise;
    mod rearm;
    mod recover;
    mod refusal;
    mod start;
    mod stop;
    mod wire;
}

//! What is promised of chances, on draws whose causes are known.

mod asked;
mod autocorrelation;
mod evidence;

"""`python -m motor_control.warm_up`: compile observer and feed-forward ahead of time, so that no running loop waits."""

from motor_control.controller.feedforward import FeedForward
from motor_control.controller.observer import Observer
from motor_model.parameters import paper_motor
from motor_model.sample import Info, Sample


def main() -> None:
    """Run every compiled function once."""
    observer = Observer(paper_motor(), Info())
    state = observer.begin(Sample(0, 0.0, 0.0), 0.0)
    estimate, state = observer.update(state, Sample(5_000_000, 0.0, 1.0, 2, 4_000_000, 0.001))
    observer.predict(state, 0.005)
    FeedForward(paper_motor()).voltage(estimate.speed, 0.0, 0.0)


if __name__ == "__main__":
    main()

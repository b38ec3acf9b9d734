"""What a running controller is set to: parameters, the plant's own account, the model in its file."""

from collections.abc import Mapping
from dataclasses import replace

from motor_control.configuration import Value, config_of, model_of
from motor_control.controller.run import Config
from motor_control.preparation import Preparation
from motor_model.sample import Info

# What a sample's edges are, and so most of what tells that they are not the motor's, only `motor/info` says.
UNHEARD = (
    "No motor/info has come yet, which says what the samples mean: see whether the plant publishes it where this node "
    "hears it (ros2 topic info -v, remappings, namespaces). The motor gets 0 V until then."
)


class Settings:
    """The configuration in force; a change that does not work leaves it as it is."""

    def __init__(self, values: Mapping[str, Value]) -> None:
        """The parameters at the start; a model that they name is ready when this returns.

        Raises:
            MotorError: a value does not work, or there is no such model.
        """
        self._values = dict(values)
        self._info: Info | None = None
        self._refused = UNHEARD  # why what the plant said of itself cannot be, or that it has said nothing yet
        self._barred = ""  # why nothing is to be driven, as far as who else is there tells
        self._motor = model_of(str(values["model"]))
        self._preparation = Preparation()
        if self._motor is not None:
            self._preparation.now()
        self._ready = self._preparation.done
        self.config: Config = self._bar(config_of(self._values, None, self._motor, self._ready))

    def change(self, values: Mapping[str, Value]) -> None:
        """Other values for some of the parameters; a model is read again whenever it is named.

        Raises:
            MotorError: one does not work, or there is no such model.
        """
        motor = model_of(str(values["model"])) if "model" in values else self._motor
        if motor is not None:
            self._preparation.begin()
        everything, ready = {**self._values, **values}, self._preparation.done
        self.config = self._bar(config_of(everything, self._info, motor, ready))
        self._values, self._motor, self._ready = everything, motor, ready

    def meet(self, info: Info) -> bool:
        """Take in what the plant says of itself; True if that is another plant than it said before.

        Raises:
            MotorError: it does not fit.
        """
        before = self._info
        if info != before or self._refused:
            config = config_of(self._values, info, self._motor, self._ready)
            self._refused, self._info = "", info
            self.config = self._bar(config)
        return before is not None and info != before

    def refuse(self, why: str) -> None:
        """Take in that the plant says of itself what cannot be, and why: 0 V until it says otherwise."""
        self._refused, self.config = why, replace(self.config, unusable=why)

    def bar(self, why: str) -> None:
        """Take in that nothing is to be driven, and why; "": it may be."""
        if why != self._barred:
            self._barred = why
            self.change({})

    def _bar(self, config: Config) -> Config:
        why = self._barred or self._refused
        return replace(config, unusable=why) if why else config

    def refresh(self) -> None:
        """Take what has been got ready meanwhile into use."""
        if self._preparation.done and not self._ready:
            self.change({})

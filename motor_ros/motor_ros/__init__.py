"""What every node of the workbench does alike: QoS, parameter tables, the plant's shell, starting and stopping."""
